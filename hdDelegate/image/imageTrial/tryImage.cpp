// SPDX-License-Identifier: Apache-2.0
// patinaTryImage BYTES: reads images with OpenImageIO, whose names come from standard input, each
// begun by a letter and ended by a zero, and writes a byte after each: t, or m where it takes more
// memory than a texture of so many bytes needs. The letter is t, or h for headers alone. A program
// of its own, because on damaged files OpenImageIO and the libraries of formats may abort or
// overrun their memory.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

namespace {

constexpr uint64_t partBytes = 64 << 20; ///< read at once, but for a single row
constexpr uint64_t ownBytes = 1 << 30;   ///< address space beside the texels: libraries, threads

/// As Patina's readers do, from the first texel to the last.
void read(const std::string& file, bool isWhole) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(file, &hints);
    if (!input) return;
    std::vector<char> texels;
    for (int image = 0; input->seek_subimage(image, 0); ++image)
        for (int level = 0; input->seek_subimage(image, level); ++level) {
            if (!isWhole) continue;
            const OIIO::ImageSpec spec = input->spec();
            const uint64_t row = std::max<uint64_t>(spec.scanline_bytes(true), 1);
            const int step = spec.tile_height > 0 ? spec.tile_height : 1;
            const int rows = int(std::clamp<uint64_t>(partBytes / row, 1, 1 << 16)) / step * step;
            for (int y = 0; y < spec.height; y += std::max(rows, step)) {
                const int end = std::min(spec.height, y + std::max(rows, step));
                texels.resize(size_t(row) * size_t(end - y));
                const bool good =
                    spec.tile_width > 0
                        ? input->read_tiles(image, level, spec.x, spec.x + spec.width, spec.y + y,
                                            spec.y + end, 0, 1, 0, spec.nchannels,
                                            OIIO::TypeUnknown, texels.data())
                        : input->read_scanlines(image, level, spec.y + y, spec.y + end, 0, 0,
                                                spec.nchannels, OIIO::TypeUnknown, texels.data());
                if (!good) return;
            }
        }
}

template <class Resource> void limit(Resource resource, rlim_t most) {
    rlimit now;
    if (::getrlimit(resource, &now) != 0) return;
    now.rlim_cur = std::min(now.rlim_max, most);
    ::setrlimit(resource, &now);
}

} // namespace

int main([[maybe_unused]] int count, [[maybe_unused]] char** arguments) {
    limit(RLIMIT_CORE, 0);
    // Threads reserve address space, on large machines more than the limit allows.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // these map terabytes
    if (count > 1) limit(RLIMIT_AS, ownBytes + std::strtoull(arguments[1], nullptr, 10));
#endif
    std::string file;
    for (char c; ::read(0, &c, 1) == 1;) {
        if (c != 0) {
            file += c;
            continue;
        }
        char answer = 't';
        try {
            if (!file.empty()) read(file.substr(1), file[0] == 't');
        } catch (const std::bad_alloc&) {
            answer = 'm';
        } catch (const std::exception&) { // Patina's reader meets it too, and says so
        }
        (void)OIIO::geterror();
        if (::write(1, &answer, 1) != 1) return 1;
        file.clear();
    }
    return 0;
}

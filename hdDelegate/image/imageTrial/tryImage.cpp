// SPDX-License-Identifier: Apache-2.0
// patinaTryImage: reads images with OpenImageIO, whose names come from standard input, each ended
// by a zero, and writes a byte after each. A program of its own, because on damaged files
// OpenImageIO and the libraries of formats may abort or overrun their memory.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

namespace {

constexpr uint64_t partBytes = 64 << 20; ///< read at once, but for a single row

/// As Patina's readers do, from the first texel to the last.
void read(const std::string& file) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(file, &hints);
    if (!input) return;
    std::vector<char> texels;
    for (int image = 0; input->seek_subimage(image, 0); ++image)
        for (int level = 0; input->seek_subimage(image, level); ++level) {
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

} // namespace

int main() {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    std::string file;
    for (char c; ::read(0, &c, 1) == 1;) {
        if (c != 0) {
            file += c;
            continue;
        }
        try {
            read(file);
        } catch (const std::exception&) { // Patina's reader meets it too, and says so
        }
        (void)OIIO::geterror();
        if (::write(1, "t", 1) != 1) return 1;
        file.clear();
    }
    return 0;
}

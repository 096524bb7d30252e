// SPDX-License-Identifier: Apache-2.0
// Checkpoints and parts of frames that others made, with right checksums.
#include "base/limits.h"
#include "hdDelegate/film/cryptomatte.h"
#include "hdDelegate/film/film.h"
#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/film/partial.h"
#include "testenv/fuzz/targets/forgeChecksums.h"
#include "testenv/fuzz/targets/memoryFile.h"
#include "testenv/fuzz/targets/targets.h"

#include <cstdlib>
#include <stdexcept>

int fuzzFilm(const uint8_t* data, size_t size) {
    using namespace patina;
    if (size < 24) return 0;
    // As for --limit textureBytes: parts may be of images as large as that, which is more than this
    // program may take.
    static const std::string refused = setLimits({{"textureBytes", uint64_t(1) << 28}});
    if (!refused.empty()) std::abort();
    std::string bytes(reinterpret_cast<const char*>(data), size);
    const bool part = bytes[6] == 'P';
    forgeChecksums(bytes, part);
    static MemoryFile file;
    const std::string path = file.with(bytes.data(), bytes.size());
    Film film;
    try {
        if (!part) {
            film.loadCheckpoint(path);
        } else {
            (void)partialDescription(path);
            mergePartial(film, path, {0.01, 1});
            mergePartial(film, path,
                         {0.01, 1}); // once more behind itself, as a farm that repeats a part does
        }
    } catch (const std::runtime_error&) {
        return 0;
    }
    if (int64_t(film.width()) * film.height() > 4096) return 0;
    for (const AovSpec& held : film.aovs()) {
        AovSpec spec; // another one, where names are there twice
        if (!film.findSpec(held.name, spec)) std::abort();
        const size_t channels = channelNames(spec).size();
        const size_t values = film.resolve(spec.name).size();
        if (channels != size_t(spec.components) || values % channels != 0) std::abort();
        if (spec.kind == AovKind::Coverage)
            (void)cryptomatteManifest(film.coverageNames(spec.name));
    }
    (void)film.resolve("color");
    return 0;
}

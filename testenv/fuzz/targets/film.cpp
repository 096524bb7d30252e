// SPDX-License-Identifier: Apache-2.0
// Checkpoints and parts of frames that others made, with right checksums.
#include "hdDelegate/film/film.h"
#include "hdDelegate/film/partial.h"
#include "testenv/fuzz/targets/forgeChecksums.h"
#include "testenv/fuzz/targets/inputLimits.h"
#include "testenv/fuzz/targets/memoryFile.h"
#include "testenv/fuzz/targets/targets.h"
#include "testenv/fuzz/targets/useFilm.h"

#include <stdexcept>

bool fuzzFilm(const uint8_t* data, size_t size) {
    using namespace patina;
    if (size < 24) return false;
    limitInputs();
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
        return false;
    }
    useFilm(film);
    return true;
}

// SPDX-License-Identifier: Apache-2.0
// The parts of one frame, as `patina merge` takes them: four bytes of settings, and parts behind
// each other, each from its first eight bytes on. Checksums are right.
#include "hdDelegate/film/film.h"
#include "hdDelegate/film/partial.h"
#include "testenv/fuzz/targets/forgeChecksums.h"
#include "testenv/fuzz/targets/inputLimits.h"
#include "testenv/fuzz/targets/memoryFile.h"
#include "testenv/fuzz/targets/targets.h"
#include "testenv/fuzz/targets/useFilm.h"

#include <stdexcept>
#include <vector>

namespace {

std::vector<std::string> partsOf(const std::string& bytes) {
    constexpr size_t most = 8, least = 24;
    std::vector<std::string> parts;
    for (size_t at = bytes.find("PatinaPT"); at != std::string::npos && parts.size() < most;) {
        const size_t next = bytes.find("PatinaPT", at + 8);
        std::string part = bytes.substr(at, next == std::string::npos ? next : next - at);
        if (part.size() >= least) {
            patina::forgeChecksums(part, true);
            parts.push_back(std::move(part));
        }
        at = next;
    }
    return parts;
}

bool merge(patina::Film& film, const std::vector<std::string>& parts,
           const patina::PartialMerge& settings) {
    static patina::MemoryFile file;
    try {
        for (const std::string& part : parts) {
            const std::string path = file.with(part.data(), part.size());
            (void)patina::partialDescription(path);
            (void)patina::mergePartial(film, path, settings);
        }
    } catch (const std::runtime_error&) {
        return false;
    }
    patina::useFilm(film);
    return !parts.empty();
}

} // namespace

bool fuzzParts(const uint8_t* data, size_t size) {
    using namespace patina;
    if (size < 28) return false;
    limitInputs();
    const std::vector<std::string> parts =
        partsOf(std::string(reinterpret_cast<const char*>(data), size));
    constexpr double tolerances[] = {0.0, 0.01, 1.0, 1e30};
    PartialErrors errors;
    PartialMerge settings{tolerances[data[0] % 4], data[1] % 16, data[2] % 16,
                          data[3] % 2 ? &errors : nullptr};
    Film film;
    if (!merge(film, parts, settings)) return false;
    settings.samples = errors.samplesOfWhole(settings.tolerance, settings.minSamples);
    settings.errors = nullptr;
    Film whole;
    return settings.samples == 0 || merge(whole, parts, settings);
}

// SPDX-License-Identifier: Apache-2.0
#include "base/imageProfile.h"

#include <cstdint>

#include <unistd.h>

namespace patina {

namespace {

constexpr int mostSteps = 10000; ///< through a file: what holds more may hold a profile

/// Numbers of a file; what cannot be read ends the walk.
struct Numbers {
    int file;
    bool isLittle = false, isGone = false;

    uint64_t at(uint64_t place, int bytes) {
        unsigned char read[8] = {};
        if (place > INT64_MAX || ::pread(file, read, size_t(bytes), off_t(place)) != bytes)
            isGone = true;
        uint64_t value = 0;
        for (int i = 0; i < bytes; ++i)
            value = value << 8 | read[isLittle ? bytes - 1 - i : i];
        return value;
    }
};

bool inPng(Numbers file) {
    constexpr uint64_t profile = 0x69434350, texels = 0x49444154; // iCCP, IDAT
    uint64_t at = 8;
    for (int i = 0; i < mostSteps && !file.isGone; ++i) {
        const uint64_t kind = file.at(at + 4, 4);
        if (kind == profile || kind == texels) return kind == profile;
        at += file.at(at, 4) + 12;
    }
    return true;
}

bool inJpeg(Numbers file) {
    constexpr uint64_t segments = 0xFFC0, profile = 0xFFE2, texels = 0xFFDA, last = 0xFFFE;
    uint64_t at = 2;
    for (int i = 0; i < mostSteps; ++i) {
        const uint64_t kind = file.at(at, 2);
        if (file.isGone || kind < segments || kind == profile || kind > last) return true;
        if (kind == texels) return false;
        at += file.at(at + 2, 2) + 2;
    }
    return true;
}

bool inTiff(Numbers file, bool isBig) {
    constexpr uint64_t profile = 34675;
    const int wide = isBig ? 8 : 4;
    uint64_t at = file.at(isBig ? 8 : 4, wide); // of a folder: a count, its entries, the next one
    for (int i = 0; at && i < mostSteps && !file.isGone;) {
        const uint64_t count = file.at(at, isBig ? 8 : 2);
        at += isBig ? 8 : 2;
        for (uint64_t k = 0; k < count && !file.isGone; ++k, at += isBig ? 20 : 12)
            if (++i > mostSteps || file.at(at, 2) == profile) return true;
        at = file.at(at, wide);
        ++i;
    }
    return at != 0 || file.isGone;
}

} // namespace

bool mayHoldProfile(int file) {
    Numbers numbers{file};
    switch (numbers.at(0, 4)) {
    case 0x762F3101: return false; // OpenEXR
    case 0x89504E47: return inPng(numbers);
    case 0x4D4D002A: return inTiff(numbers, false);
    case 0x4D4D002B: return inTiff(numbers, true);
    case 0x49492A00: numbers.isLittle = true; return inTiff(numbers, false);
    case 0x49492B00: numbers.isLittle = true; return inTiff(numbers, true);
    }
    if (numbers.at(0, 3) == 0xFFD8FF) return inJpeg(numbers);
    return numbers.at(0, 2) != 0x233F; // Radiance
}

} // namespace patina

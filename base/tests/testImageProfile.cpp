// SPDX-License-Identifier: Apache-2.0
// Headers of images that may hold an ICC profile.
#include "base/imageProfile.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

using namespace patina;

namespace {

bool may(const std::string& bytes) {
    FILE* const file = std::tmpfile();
    std::fwrite(bytes.data(), 1, bytes.size(), file);
    std::fflush(file);
    const bool found = mayHoldProfile(::fileno(file));
    std::fclose(file);
    return found;
}

std::string number(uint64_t value, int bytes, bool isLittle) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += char(value >> 8 * (isLittle ? i : bytes - 1 - i));
    return text;
}

std::string chunk(const std::string& kind, size_t size) {
    return number(size, 4, false) + kind + std::string(size + 4, 'x');
}

std::string segment(int kind, size_t size) {
    return '\xff' + number(uint64_t(kind), 1, false) + number(size + 2, 2, false) +
           std::string(size, 'x');
}

const std::string png = "\x89PNG\r\n\x1a\n", jpeg = "\xff\xd8";

/// Two folders of two entries each, the last of which has this tag.
std::string tiff(bool isBig, bool isLittle, int tag, bool isEndless = false) {
    const int wide = isBig ? 8 : 4;
    std::string file = isLittle ? "II" : "MM";
    file += number(isBig ? 43 : 42, 2, isLittle);
    if (isBig) file += number(8, 2, isLittle) + number(0, 2, isLittle);
    file += number(uint64_t(file.size()) + uint64_t(wide), wide, isLittle);
    const size_t first = file.size();
    for (int folder = 0; folder < 2; ++folder) {
        file += number(2, isBig ? 8 : 2, isLittle);
        for (const int own : {256, folder ? tag : 257})
            file += number(uint64_t(own), 2, isLittle) + std::string(isBig ? 18 : 10, '\0');
        file +=
            number(folder ? (isEndless ? first : 0) : file.size() + size_t(wide), wide, isLittle);
    }
    return file;
}

} // namespace

TEST(ImageProfile, IsFoundBeforeTexels) {
    EXPECT_TRUE(may(png + chunk("IHDR", 13) + chunk("iCCP", 40) + chunk("IDAT", 9)));
    EXPECT_FALSE(may(png + chunk("IHDR", 13) + chunk("sRGB", 1) + chunk("IDAT", 9)));
    EXPECT_TRUE(may(jpeg + segment(0xE0, 14) + segment(0xE2, 40) + segment(0xDA, 9)));
    EXPECT_FALSE(may(jpeg + segment(0xE0, 14) + segment(0xDB, 65) + segment(0xDA, 9)));
}

TEST(ImageProfile, IsFoundInAnyFolder) {
    for (const bool isBig : {false, true})
        for (const bool isLittle : {false, true}) {
            EXPECT_TRUE(may(tiff(isBig, isLittle, 34675)));
            EXPECT_FALSE(may(tiff(isBig, isLittle, 34674)));
        }
}

TEST(ImageProfile, DamagedAndOtherImagesMayHoldOne) {
    EXPECT_TRUE(may(png + chunk("IHDR", 13)));
    EXPECT_TRUE(may(jpeg + segment(0xE0, 14)));
    EXPECT_TRUE(may(jpeg + "no segment"));
    EXPECT_TRUE(may(tiff(false, true, 1, true)));
    EXPECT_TRUE(may(tiff(false, true, 1).substr(0, 40)));
    EXPECT_TRUE(may("8BPS"));
    EXPECT_TRUE(may(""));
}

TEST(ImageProfile, FormatsWithoutProfilesHoldNone) {
    EXPECT_FALSE(may("\x76\x2f\x31\x01\x02"));
    EXPECT_FALSE(may("#?RADIANCE"));
}

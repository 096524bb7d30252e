// SPDX-License-Identifier: Apache-2.0
// Headers of OpenEXR that claim more than their file holds.
#include "base/exrClaims.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

using namespace patina;

namespace {

std::string number(uint32_t value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + number(uint32_t(value.size())) + value;
}

std::string listOf(int channels) {
    std::string list;
    for (int i = 0; i < channels; ++i)
        list += std::string("c\0", 2) + std::string(16, '\1');
    return list + '\0';
}

std::string header(uint32_t width, uint32_t tile, int channels, char flags = 0) {
    return std::string("\x76\x2f\x31\x01\x02", 5) + flags + std::string(2, '\0') +
           attribute("channels", "chlist", listOf(channels)) +
           attribute("dataWindow", "box2i", number(0) + number(0) + number(width - 1) + number(9)) +
           (tile ? attribute("tiles", "tiledesc", number(tile) + number(tile) + '\0') : "") + '\0';
}

bool claimsMore(const std::string& bytes) {
    FILE* const file = std::tmpfile();
    std::fwrite(bytes.data(), 1, bytes.size(), file);
    std::fflush(file);
    const bool found = exrClaimsMore(::fileno(file));
    std::fclose(file);
    return found;
}

} // namespace

TEST(ExrClaims, ImagesAreTaken) {
    EXPECT_FALSE(claimsMore(header(100000, 0, 4)));
    EXPECT_FALSE(claimsMore(header(1 << 30, 64, 4)));
    EXPECT_FALSE(claimsMore(header(16, 2048, 4)));
    EXPECT_FALSE(claimsMore(header(1 << 20, 8192, 4) + std::string(1 << 16, 'x'))); // one colour
    EXPECT_FALSE(claimsMore("no image"));
    EXPECT_FALSE(claimsMore(""));
}

TEST(ExrClaims, MoreThanAFileHolds) {
    EXPECT_TRUE(claimsMore(header(1 << 30, 0, 1)));
    EXPECT_TRUE(claimsMore(header(0, 0, 1))); // 2^32 columns
    EXPECT_TRUE(claimsMore(header(16, 1 << 15, 1)));
    EXPECT_TRUE(claimsMore(header(1 << 18, 0, 200)));
    const std::string text =
        std::string("name\0string\0", 12) + number(0x7fffffff) + std::string(40, 't');
    const std::string sound = header(16, 16, 3);
    EXPECT_TRUE(claimsMore(sound.substr(0, 8) + text));
    EXPECT_FALSE(claimsMore(sound + text)); // behind the header
    const std::string part = header(16, 16, 3, 0x10);
    EXPECT_TRUE(claimsMore(part + text));
    EXPECT_FALSE(claimsMore(part + header(16, 0, 3).substr(8) + '\0' + text));
    EXPECT_TRUE(claimsMore(part + header(1 << 30, 0, 1).substr(8) + '\0'));
}

// Of many types OpenEXR reads as much as they have, and goes on there.
TEST(ExrClaims, SizesAreThoseOfTypes) {
    const std::string begin = header(16, 16, 3).substr(0, 8);
    EXPECT_FALSE(claimsMore(begin + attribute("lineOrder", "lineOrder", "1")));
    EXPECT_TRUE(claimsMore(begin + attribute("lineOrder", "lineOrder", "12")));
    EXPECT_FALSE(claimsMore(begin + attribute("p", "preview", number(1) + number(2) + "rgbargba")));
    EXPECT_TRUE(claimsMore(begin + attribute("p", "preview", number(9) + number(9) + "rgbargba")));
    EXPECT_TRUE(claimsMore(begin + attribute("p", "preview", "1")));
    EXPECT_TRUE(claimsMore(begin + attribute("channels", "chlist", listOf(2) + "more")));
    EXPECT_TRUE(claimsMore(begin + attribute("channels", "chlist", listOf(2).substr(0, 30))));
    EXPECT_TRUE(claimsMore(begin + attribute("channels", "chlist", "")));
}

TEST(ExrClaims, DamagedHeadersEnd) {
    const std::string sound = header(16, 16, 3, 0x10);
    for (size_t size = 0; size < sound.size(); ++size)
        (void)claimsMore(sound.substr(0, size));
    EXPECT_FALSE(claimsMore(sound.substr(0, 8) + std::string(1000, 'n')));
}

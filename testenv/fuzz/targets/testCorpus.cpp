// SPDX-License-Identifier: Apache-2.0
// Findings of fuzzers stay found: every kept input goes through its reader again.
#include "hdDelegate/film/imageFile.h"
#include "testenv/fuzz/targets/targets.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using Target = bool (*)(const uint8_t*, size_t);

std::filesystem::directory_iterator kept(const std::string& name) {
    return std::filesystem::directory_iterator(PATINA_CORPUS "/" + name);
}

class Readers : public testing::TestWithParam<std::pair<const char*, Target>> {};

} // namespace

TEST_P(Readers, StayFound) {
    const auto [name, target] = GetParam();
    int sound = 0;
    for (const auto& entry : kept(name)) {
        SCOPED_TRACE(entry.path().string());
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(in), {});
        const bool taken = target(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
        // A reader that refuses what fuzzers start from hides all that lies behind.
        if (entry.path().filename().string().rfind("sound", 0) == 0) {
            EXPECT_TRUE(taken);
            ++sound;
        }
    }
    EXPECT_GT(sound, 0); // a corpus that has moved is no corpus that passes
}

// Of formats that no fuzzer tries: the reader of one does not end on some inputs.
TEST(FuzzCorpus, OtherFormatsStayFound) {
    int count = 0;
    for (const auto& entry : kept("otherFormats")) {
        EXPECT_FALSE(patina::readImage(entry.path().string()).pixels.empty());
        ++count;
    }
    EXPECT_GT(count, 0);
}

#define PATINA_TARGET(name, function) std::pair<const char*, Target>(name, function)
INSTANTIATE_TEST_SUITE_P(
    FuzzCorpus, Readers,
    testing::Values(PATINA_TARGET("film", fuzzFilm), PATINA_TARGET("ies", fuzzIes),
                    PATINA_TARGET("image", fuzzImage), PATINA_TARGET("mtlx", fuzzMtlx),
                    PATINA_TARGET("mtlxIncludes", fuzzMtlxIncludes),
                    PATINA_TARGET("network", fuzzNetwork), PATINA_TARGET("parts", fuzzParts),
                    PATINA_TARGET("texture", fuzzTexture)),
    [](const auto& info) { return std::string(info.param.first); });

// SPDX-License-Identifier: Apache-2.0
// Findings of fuzzers stay found: every kept input goes through its reader again.
#include "testenv/fuzz/targets/targets.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

int runAll(const char* name, int (*target)(const uint8_t*, size_t)) {
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(PATINA_CORPUS "/") + name)) {
        SCOPED_TRACE(entry.path().string());
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(in), {});
        EXPECT_EQ(target(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()), 0);
        ++count;
    }
    return count;
}

} // namespace

// Each has one at least, so that a corpus that has moved is no corpus that passes.
TEST(FuzzCorpus, Film) {
    EXPECT_GT(runAll("film", fuzzFilm), 0);
}
TEST(FuzzCorpus, Ies) {
    EXPECT_GT(runAll("ies", fuzzIes), 0);
}
TEST(FuzzCorpus, Image) {
    EXPECT_GT(runAll("image", fuzzImage), 0);
}
TEST(FuzzCorpus, Mtlx) {
    EXPECT_GT(runAll("mtlx", fuzzMtlx), 0);
}
TEST(FuzzCorpus, Network) {
    EXPECT_GT(runAll("network", fuzzNetwork), 0);
}

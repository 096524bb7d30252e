// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/film.h"
#include "hdDelegate/film/tests/tempFolder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

namespace patina {

namespace {

const std::vector<AovSpec> someAovs = {standardAov("albedo"), standardAov("primId"),
                                       standardAov("primvars:st"), standardAov("variance")};

/// Fills a film from numbers of its own generator, so that two films can be continued alike.
void addSamples(Film& film, std::mt19937& random, int samples) {
    std::uniform_real_distribution<float> u(0.0f, 3.0f);
    for (int s = 0; s < samples; ++s)
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) {
                glm::vec3 c(u(random), u(random), u(random));
                film.addColor(x, y, c, u(random) < 2.8f ? 1.0f : -1.0f);
                film.addAov(0, x, y, &c.x, u(random));
                film.addAov(1, x, y, &c.y, u(random));
                film.addAov(2, x, y, &c.y, u(random));
            }
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

std::string bytesOf(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

void writeBytes(const std::string& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

std::string reasonOfLoad(Film& film, const std::string& file) {
    try {
        film.loadCheckpoint(file);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST(Checkpoint, ContinuedFilmIsBitForBitTheUninterruptedOne) {
    TempFolder temp;
    std::mt19937 random(7);
    Film whole;
    whole.reset(13, 7, someAovs);
    whole.resumeToken = "scene 1, seed 7";
    addSamples(whole, random, 5);
    whole.saveCheckpoint(temp.file("a.checkpoint"));

    Film continued;
    continued.reset(2, 2, {});
    continued.loadCheckpoint(temp.file("a.checkpoint"));
    EXPECT_EQ(continued.resumeToken, "scene 1, seed 7");
    EXPECT_EQ(continued.droppedSamples(), whole.droppedSamples());
    EXPECT_GT(whole.droppedSamples(), 0u);
    continued.reset(13, 7, someAovs, true);

    std::mt19937 sameRandom = random;
    addSamples(whole, random, 4);
    addSamples(continued, sameRandom, 4);
    for (const char* name :
         {"color", "alpha", "variance", "sampleCount", "albedo", "primId", "primvars:st"})
        EXPECT_TRUE(sameBits(whole.resolve(name), continued.resolve(name))) << name;
    EXPECT_EQ(temp.fileCount(), 1u) << "temporaries stay behind";
}

TEST(Checkpoint, EveryTruncationAndEveryFlippedByteIsNoticed) {
    TempFolder temp;
    std::mt19937 random(3);
    Film film, other;
    film.reset(2, 1, someAovs);
    addSamples(film, random, 2);
    film.saveCheckpoint(temp.file("good"));
    std::string good = bytesOf(temp.file("good"));
    other.reset(1, 1, {});
    other.addColor(0, 0, {1, 2, 3}, 1);
    for (size_t size = 0; size < good.size(); ++size) {
        writeBytes(temp.file("bad"), good.substr(0, size));
        ASSERT_TRUE(has(reasonOfLoad(other, temp.file("bad")), "bad")) << size;
    }
    for (size_t at = 0; at < good.size(); ++at) {
        std::string bad = good;
        bad[at] = char(bad[at] ^ 0x10);
        writeBytes(temp.file("bad"), bad);
        ASSERT_FALSE(reasonOfLoad(other, temp.file("bad")).empty()) << at;
    }
    writeBytes(temp.file("bad"), good + "x");
    EXPECT_FALSE(reasonOfLoad(other, temp.file("bad")).empty());
    EXPECT_EQ(other.color(0, 0), glm::vec3(1, 2, 3)) << "a failed load changes nothing";
    EXPECT_EQ(reasonOfLoad(other, temp.file("good")), "");
}

TEST(Checkpoint, ReasonsAreNamed) {
    TempFolder temp;
    Film film;
    film.reset(2, 2, {});
    film.saveCheckpoint(temp.file("good"));
    std::string good = bytesOf(temp.file("good"));
    writeBytes(temp.file("image"), std::string(200, 'P'));
    EXPECT_TRUE(has(reasonOfLoad(film, temp.file("image")), "not a checkpoint"));
    std::string newer = good;
    newer[8] = 99;
    writeBytes(temp.file("newer"), newer);
    EXPECT_TRUE(has(reasonOfLoad(film, temp.file("newer")), "version 99"));
    writeBytes(temp.file("short"), good.substr(0, good.size() / 2));
    EXPECT_TRUE(has(reasonOfLoad(film, temp.file("short")), "truncated"));
    std::string flipped = good;
    flipped[good.size() - 20] ^= 1;
    writeBytes(temp.file("flipped"), flipped);
    EXPECT_TRUE(has(reasonOfLoad(film, temp.file("flipped")), "damaged"));
    EXPECT_TRUE(has(reasonOfLoad(film, temp.file("absent")), "does not exist"));
}

TEST(Checkpoint, UnwritablePlacesAreRefusedAndLeaveTheOldFile) {
    TempFolder temp;
    Film film;
    film.reset(2, 2, {});
    EXPECT_THROW(film.saveCheckpoint(temp.file("no/such/folder/x")), std::runtime_error);
    EXPECT_THROW(film.saveCheckpoint(temp.path().string()), std::runtime_error);
    EXPECT_EQ(temp.fileCount(), 0u);
}

} // namespace patina

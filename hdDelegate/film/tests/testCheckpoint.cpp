// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/tests/filmFixtures.h"

#include <random>

namespace patina {

namespace {

const std::vector<AovSpec> someAovs = {standardAov("albedo"), standardAov("primId"),
                                       standardAov("primvars:st"), standardAov("variance")};

/// Fills a film from numbers of its own generator, so that two films can be continued alike.
void addSamples(Film& film, std::mt19937& random, int samples) {
    std::uniform_real_distribution<float> u(0.0f, 3.0f);
    for (int s = 0; s < samples; ++s)
        forPixels(film, [&](int x, int y) {
            glm::vec3 c(u(random), u(random), u(random));
            film.addColor(x, y, c, u(random) < 2.8f ? 1.0f : -1.0f);
            film.addAov(0, x, y, &c.x, u(random));
            film.addAov(1, x, y, &c.y, u(random));
            film.addAov(2, x, y, &c.y, u(random));
        });
}

std::string reasonOfLoad(Film& film, const std::string& file) {
    return reasonOf([&] { film.loadCheckpoint(file); });
}

} // namespace

TEST(Checkpoint, ContinuedFilmIsBitForBitTheUninterruptedOne) {
    TempFolder temp;
    std::mt19937 random(7);
    TestFilm whole(13, 7, someAovs);
    whole.resumeToken = "scene 1, seed 7";
    addSamples(whole, random, 5);
    whole.saveCheckpoint(temp.file("a.checkpoint"));

    TestFilm continued(2, 2);
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
    TestFilm film(2, 1, someAovs), other(1, 1);
    addSamples(film, random, 2);
    film.saveCheckpoint(temp.file("good"));
    std::string good = bytesOfFile(temp.file("good"));
    other.addColor(0, 0, {1, 2, 3}, 1);
    for (size_t size = 0; size < good.size(); ++size) {
        writeFile(temp.file("bad"), good.substr(0, size));
        ASSERT_TRUE(has(reasonOfLoad(other, temp.file("bad")), "bad")) << size;
    }
    for (size_t at = 0; at < good.size(); ++at) {
        std::string bad = good;
        bad[at] = char(bad[at] ^ 0x10);
        writeFile(temp.file("bad"), bad);
        ASSERT_FALSE(reasonOfLoad(other, temp.file("bad")).empty()) << at;
    }
    writeFile(temp.file("bad"), good + "x");
    EXPECT_FALSE(reasonOfLoad(other, temp.file("bad")).empty());
    EXPECT_EQ(other.color(0, 0), glm::vec3(1, 2, 3)) << "a failed load changes nothing";
    EXPECT_EQ(reasonOfLoad(other, temp.file("good")), "");
}

TEST(Checkpoint, ReasonsAreNamed) {
    TempFolder temp;
    TestFilm film(2, 2);
    film.saveCheckpoint(temp.file("good"));
    const std::string good = bytesOfFile(temp.file("good"));
    std::string newer = good, flipped = good;
    newer[8] = 99;
    flipped[good.size() - 20] ^= 1;
    for (const auto& [bytes, reason] : {std::pair(std::string(200, 'P'), "not a checkpoint"),
                                        {newer, "version 99"},
                                        {good.substr(0, good.size() / 2), "truncated"},
                                        {flipped, "damaged"}}) {
        writeFile(temp.file("bad"), bytes);
        EXPECT_TRUE(has(reasonOfLoad(film, temp.file("bad")), reason)) << reason;
    }
    EXPECT_TRUE(has(reasonOfLoad(film, temp.file("absent")), "does not exist"));
}

TEST(Checkpoint, UnwritablePlacesAreRefusedAndLeaveTheOldFile) {
    TempFolder temp;
    TestFilm film(2, 2);
    EXPECT_THROW(film.saveCheckpoint(temp.file("no/such/folder/x")), std::runtime_error);
    EXPECT_THROW(film.saveCheckpoint(temp.path().string()), std::runtime_error);
    EXPECT_EQ(temp.fileCount(), 0u);
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/partial.h"

#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/film/spans.h"
#include "hdDelegate/film/tests/filmFixtures.h"
#include "base/limits.h"

#include <cmath>
#include <filesystem>
#include <random>

namespace patina {

namespace {

constexpr int width = 37, height = 21; // neither is a multiple of a tile's side

const std::vector<AovSpec> someAovs = {standardAov("albedo"), standardAov("primId"),
                                       standardAov("normal")};

/// A sample that depends on pixel and index alone, with a range that makes sums round.
void addSample(Film& film, int x, int y, uint32_t index) {
    std::minstd_rand random(index * 7919u + uint32_t(y) * 131u + uint32_t(x) + 1u);
    random.discard(3);
    std::uniform_real_distribution<float> exponent(-20.0f, 20.0f), u(-1.0f, 1.0f);
    const glm::vec3 values(u(random), u(random), u(random));
    for (int aov = 0; aov < 3; ++aov)
        film.addAov(aov, x, y, &values.x, u(random) + 1.0f);
    const float dropped = random() % 50 == 0 ? -1.0f : 1.0f;
    film.addColor(x, y,
                  dropped * glm::vec3(std::exp2(exponent(random)), std::exp2(exponent(random)),
                                      std::exp2(exponent(random))),
                  0.3f);
}

void addSamples(Film& film, const Tile& tile, uint32_t begin, uint32_t end) {
    forTile(tile, [&](int x, int y) {
        for (uint32_t i = begin; i < end; ++i)
            addSample(film, x, y, i);
    });
}

std::string bytesOf(const Film& film, const TempFolder& temp) {
    film.saveCheckpoint(temp.file("bytes"));
    return bytesOfFile(temp.file("bytes"));
}

void savePart(const std::string& file, const std::vector<Tile>& tiles, uint32_t begin,
              uint32_t end) {
    PartialWriter writer(file, "", tiles);
    for (uint32_t first = begin; first < end;) {
        const uint32_t last = first == 0 ? end : std::min(nextSpanEnd(first), end);
        TestFilm film(width, height, someAovs);
        film.setFirstSample(first);
        for (const Tile& tile : tiles)
            addSamples(film, tile, first, last);
        writer.add(film);
        first = last;
    }
    writer.commit("");
}

} // namespace

TEST(Spans, EndWhereTilesStopAndErrorsAreLookedAt) {
    uint32_t end = 0;
    for (int step = 0; step < (1 << 20); step = nextStep(step, 1 << 21)) {
        if (uint32_t(step) == nextSpanEnd(end)) end = uint32_t(step);
        EXPECT_LT(uint32_t(step), nextSpanEnd(end)) << "tiles step over the end of a span";
        EXPECT_EQ(isSpanEnd(uint32_t(step)), step > 0 && uint32_t(step) == end);
    }
    for (int samples = 1; samples < (1 << 16); ++samples)
        EXPECT_TRUE(isSpanEnd(uint32_t(samples)) || !isErrorStep(samples)) << samples;
}

TEST(Tiles, PartsHoldEachTileOnceAndEquallyMany) {
    const std::vector<Tile> all = tilesOf(width, height, {3, 2, 30, 19});
    for (int parts : {1, 2, 3, 4, 7}) {
        std::vector<int> covered(size_t(width * height), 0);
        for (int part = 0; part < parts; ++part) {
            const std::vector<Tile> tiles = tilesOfPart(all, part, parts);
            EXPECT_LE(tiles.size(), all.size() / size_t(parts) + 1);
            EXPECT_GE(tiles.size(), all.size() / size_t(parts));
            for (const Tile& t : tiles)
                forTile(t, [&](int x, int y) { ++covered[size_t(y * width + x)]; });
        }
        forTile({0, 0, width, height}, [&](int x, int y) {
            EXPECT_EQ(covered[size_t(y * width + x)], x >= 3 && x <= 30 && y >= 2 && y <= 19);
        });
    }
}

/// Every accumulator, and so the film's checkpoint, is that of the film that took all samples.
TEST(Partial, AnyCutAddsUpToTheBitsOfTheWhole) {
    const TempFolder temp;
    for (const uint32_t samples : {5u, 100u, 300u}) {
        TestFilm whole(width, height, someAovs);
        addSamples(whole, {0, 0, width, height}, 0, samples);
        const std::string expected = bytesOf(whole, temp);
        const std::vector<Tile> tiles = tilesOf(width, height, {0, 0, -1, -1});
        for (const auto& ends : std::vector<std::vector<uint32_t>>{
                 {samples}, {1, 4, samples}, {4, 64, 80, 96, samples}, {2, 48, samples}}) {
            Film merged;
            for (int part = 2; part >= 0; --part) {
                uint32_t begin = 0;
                for (const uint32_t cut : ends) {
                    const uint32_t end = std::min(cut, samples);
                    if (end <= begin) continue;
                    savePart(temp.file("part"), tilesOfPart(tiles, part, 3), begin, end);
                    mergePartial(merged, temp.file("part"), {});
                    begin = end;
                }
            }
            EXPECT_EQ(bytesOf(merged, temp), expected) << samples << " samples";
        }
    }
}

/// Whoever may write to the folder of parts would lead them to any file of the user's.
TEST(Partial, LinksInItsPlaceAreReplaced) {
    const TempFolder temp;
    const std::string part = temp.file("part"), other = temp.file("other");
    std::ofstream(other) << "mine";
    for (const bool early : {true, false})
        for (const std::string& target : {other, temp.file("none")}) {
            std::filesystem::remove(part);
            if (early) std::filesystem::create_symlink(target, part);
            PartialWriter writer(part, "", {{0, 0, 1, 1}});
            if (!early) std::filesystem::create_symlink(target, part);
            writer.commit("report");
            EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(part)));
            Film film;
            EXPECT_EQ(mergePartial(film, part, {}), "report");
        }
    EXPECT_EQ(std::filesystem::file_size(other), 4u);
    EXPECT_FALSE(std::filesystem::exists(temp.file("none")));
}

/// Sums in one order are not those in another: without spans the test above would pass for nothing.
TEST(Partial, CutsBetweenTheEndsOfSpansWouldShow) {
    const TempFolder temp;
    TestFilm whole(width, height, someAovs);
    addSamples(whole, {0, 0, width, height}, 0, 100);
    const std::vector<Tile> tiles = tilesOf(width, height, {0, 0, -1, -1});
    Film merged;
    for (const auto& [begin, end] : {std::pair(0u, 41u), std::pair(41u, 100u)}) {
        TestFilm film(width, height, someAovs);
        for (const Tile& tile : tiles)
            addSamples(film, tile, begin, end);
        PartialWriter writer(temp.file("part"), "", tiles);
        film.setFirstSample(begin);
        writer.add(film);
        writer.commit("");
        mergePartial(merged, temp.file("part"), {});
    }
    EXPECT_NE(bytesOf(merged, temp), bytesOf(whole, temp));
}

TEST(Partial, TruncationsAndFlippedBytesAreNoticed) {
    const TempFolder temp;
    savePart(temp.file("good"), {{0, 0, 2, 2}}, 0, 1);
    const std::string good = bytesOfFile(temp.file("good"));
    const auto refused = [&](const std::string& bytes) {
        writeFile(temp.file("bad"), bytes);
        Film film;
        EXPECT_THROW(mergePartial(film, temp.file("bad"), {}), std::runtime_error);
    };
    for (size_t size = 0; size < good.size(); size += 3)
        refused(good.substr(0, size));
    for (size_t i = 0; i < good.size(); i += 2) {
        std::string flipped = good;
        flipped[i] ^= 0x10;
        refused(flipped);
    }
    Film film;
    mergePartial(film, temp.file("good"), {});
    EXPECT_EQ(film.sampleCount(1, 1), 1u);
}

/// Parts of two tiles each, which kept a film of 16 samples and one of 32, as far as they went on.
TEST(Partial, TheWholeMayBeDoneBeforeItsParts) {
    const TempFolder temp;
    const std::vector<Tile> tiles = tilesOf(width, height, {0, 0, width - 1, height - 1});
    const auto add = [&](Film& film, const Tile& tile, int samples) {
        forTile(tile, [&](int x, int y) {
            for (int i = int(film.sampleCount(x, y)); i < samples; ++i) {
                std::minstd_rand random(uint32_t(i * 7919 + y * 131 + x + 1));
                random.discard(3);
                std::uniform_real_distribution<float> u(0.5f, 1.5f);
                film.addColor(x, y, glm::vec3(tile.x0 ? u(random) : 1.0f), 1.0f);
            }
        });
    };
    TestFilm whole(width, height); // one column of tiles is quiet, the others are noisy
    for (const Tile& tile : tiles)
        add(whole, tile, 16);
    const double error = relativeError(whole, 0, 0, width, height);
    std::vector<std::string> files;
    for (int part = 0; part < 2; ++part) {
        const std::vector<Tile> own = tilesOfPart(tiles, part, 2);
        files.push_back(temp.file(part ? "b.part" : "a.part"));
        PartialWriter writer(files.back(), "", own);
        TestFilm film(width, height);
        for (int samples : {16, 32}) {
            for (const Tile& tile : own)
                add(film, tile, tile.x0 ? samples : 16);
            writer.add(film);
        }
        writer.commit("");
    }
    PartialErrors errors;
    Film far;
    for (const std::string& file : files)
        mergePartial(far, file, {0.01, 16, 0, &errors});
    EXPECT_EQ(far.sampleCount(width - 1, 0), 32u);
    EXPECT_EQ(errors.samplesOfWhole(1.2 * error, 16), 16);
    EXPECT_EQ(errors.samplesOfWhole(1.2 * error, 17), 0) << "the least";
    EXPECT_EQ(errors.samplesOfWhole(0.01, 16), 0) << "they went on for good reason";
    Film merged;
    for (const std::string& file : files)
        mergePartial(merged, file, {0.01, 16, 16, nullptr});
    EXPECT_EQ(bytesOf(merged, temp), bytesOf(whole, temp));
}

TEST(Partial, ASmallFileAsksForNoImageBeyondALimit) {
    TempFolder temp;
    const std::string file = temp.file("a.part");
    TestFilm film(1024, 1024);
    PartialWriter writer(file, "{}", {{1023, 1023, 1024, 1024}});
    writer.add(film);
    writer.commit("");
    Film merged;
    mergePartial(merged, file, {});
    EXPECT_EQ(merged.width(), 1024);
    setLimits({{"textureBytes", 1000000}});
    Film refused;
    EXPECT_TRUE(has(reasonOf([&] { mergePartial(refused, file, {}); }), "--limit textureBytes"))
        << "an image of 100 MB";
    setLimits({});
    EXPECT_EQ(refused.width(), 0);
}

} // namespace patina

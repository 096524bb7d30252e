// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/cryptomatte.h"
#include "hdDelegate/film/cryptomatteHash.h"
#include "hdDelegate/film/partial.h"
#include "hdDelegate/film/tests/filmFixtures.h"

#include <cmath>

namespace patina {

namespace {

float idOf(const std::string& name) {
    return floatOfBits(int32_t(cryptomatteId(name)));
}

/// Samples of one pixel: letters are names, a space meets nothing.
void take(Film& film, const std::string& samples, int x = 0) {
    for (const char c : samples) {
        if (c != ' ') film.addCoverage(0, x, 0, std::string(1, c));
        film.addColor(x, 0, glm::vec3(0.5f), 1.0f);
    }
}

Film& cleared(Film& film, int width, int levels = 6) {
    film.reset(width, 1, renderedAovs({"cryptoObject"}, levels));
    return film;
}

/// A part of one pixel.
void writePart(const std::string& file, const Film& film) {
    PartialWriter writer(file, "", {{0, 0, 1, 1}});
    writer.add(film);
    writer.commit("");
}

} // namespace

// Austin Appleby's own numbers, as every implementation has them.
TEST(Cryptomatte, TheHashIsMurmurHash3) {
    const std::map<std::string, uint32_t> hashes = {
        {"", 0u},
        {"a", 0x3c2569b2u},
        {"ab", 0x9bbfd75fu},
        {"abc", 0xb3dd93fau},
        {"test", 0xba6bd213u},
        {"The quick brown fox jumps over the lazy dog", 0x2e4ff723u}};
    for (const auto& [text, hash] : hashes)
        EXPECT_EQ(murmurHash3(text), hash) << text;
}

// The vectors of Psyop's own tests of Cryptomatte.
TEST(Cryptomatte, IdsAreThoseOfTheReferenceImplementation) {
    EXPECT_EQ(idOf("hello"), 6.0705627102400005616e-17f);
    EXPECT_EQ(idOf("cube"), -4.08461912519e+15f);
    EXPECT_EQ(idOf("sphere"), 2.79018604383e+15f);
    EXPECT_EQ(idOf("plane"), 3.66557617593e-11f);
    EXPECT_EQ(idOf("m\xc3\xa4"
                   "dchen"),
              6.2361298211599995797e+25f);
    EXPECT_EQ(idOf("\xd1\x80\xd0\xb0\xd0\xb2\xd0\xbd\xd0\xb8\xd0\xbd\xd0\xb0"),
              -1.3192631212399999468e-25f);
}

TEST(Cryptomatte, IdsAreNormalNumbers) {
    int fixed = 0;
    for (int i = 0; i < 100000; ++i) {
        const std::string name = "/World/prim_" + std::to_string(i);
        EXPECT_TRUE(std::isnormal(idOf(name))) << name;
        fixed += murmurHash3(name) != cryptomatteId(name);
    }
    EXPECT_GT(fixed, 0) << "two of 256 exponents are no normal number's";
}

TEST(Cryptomatte, PixelsHoldIdsByTheirShareOfTheSamples) {
    Film film;
    take(cleared(film, 1), "abbb cc ");
    const std::vector<float> values = film.resolve("cryptoObject");
    EXPECT_EQ(values, (std::vector<float>{idOf("b"), 3.0f / 8.0f, idOf("c"), 2.0f / 8.0f, idOf("a"),
                                          1.0f / 8.0f, 0, 0, 0, 0, 0, 0}));
}

TEST(Cryptomatte, LevelsSayHowManyIdsAnImageHolds) {
    EXPECT_EQ(cryptomatteComponents(1), 4);
    EXPECT_EQ(cryptomatteComponents(5), 12);
    EXPECT_EQ(cryptomatteComponents(16), 32);
    Film film;
    take(cleared(film, 1, 2), "aaabbc");
    const std::vector<float> values = film.resolve("cryptoObject");
    ASSERT_EQ(values.size(), 4u);
    EXPECT_EQ(values[1], 3.0f / 6.0f);
    EXPECT_EQ(values[3], 2.0f / 6.0f) << "the least id has no place";
    AovSpec spec;
    ASSERT_TRUE(film.findSpec("cryptoObject", spec));
    const std::vector<std::string> channels = {"crypto_object00.R", "crypto_object00.G",
                                               "crypto_object00.B", "crypto_object00.A"};
    EXPECT_EQ(channelNames(spec), channels);
}

TEST(Cryptomatte, ManifestsAreJson) {
    CoverageNames names;
    names.add(cryptomatteId("cube"), "cube");
    names.add(0x3fu, "/a\"b\\c\n");
    EXPECT_EQ(cryptomatteManifest(names.all()),
              "{\"/a\\\"b\\\\c\\u000a\":\"0000003f\",\"cube\":\"" + hexOf(cryptomatteId("cube")) +
                  "\"}");
    EXPECT_EQ(cryptomatteManifest({}), "{}");
}

TEST(Cryptomatte, TwoNamesWithOneIdKeepTheFirstInTheAlphabet) {
    CoverageNames names, turned;
    names.add(1, "a");
    names.add(1, "b");
    turned.add(1, "b");
    turned.add(1, "a");
    EXPECT_EQ(names.all(), turned.all());
    EXPECT_EQ(names.all().at(1), "a");
}

TEST(Cryptomatte, PartsAddUpToTheWholeFilm) {
    const TempFolder temp;
    const std::string samples = "aabacb  cabbacdaaaaaaaaaaaaaaaaa";
    Film whole, first, second, merged;
    take(cleared(whole, 1), samples);
    take(cleared(first, 1), samples.substr(0, 16));
    cleared(second, 1).setFirstSample(16);
    take(second, samples.substr(16));
    int n = 0;
    for (Film* film : {&first, &second}) {
        const std::string file = temp.file("part" + std::to_string(n++));
        writePart(file, *film);
        mergePartial(merged, file, {});
    }
    EXPECT_EQ(merged.resolve("cryptoObject"), whole.resolve("cryptoObject"));
    EXPECT_EQ(merged.coverageNames("cryptoObject"), whole.coverageNames("cryptoObject"));
    EXPECT_EQ(merged.coverageNames("cryptoObject").size(), 4u);
}

TEST(Cryptomatte, CheckpointsHoldIdsAndNames) {
    const TempFolder temp;
    Film film, loaded, copy;
    take(cleared(film, 2), "abca");
    take(film, " dd ", 1);
    film.saveCheckpoint(temp.file("c"));
    loaded.loadCheckpoint(temp.file("c"));
    copy.copyFrom(loaded);
    for (const Film* other : {&loaded, &copy}) {
        EXPECT_EQ(other->resolve("cryptoObject"), film.resolve("cryptoObject"));
        EXPECT_EQ(other->coverageNames("cryptoObject"), film.coverageNames("cryptoObject"));
    }
}

// The largest ids are there before the room is full, as in a pixel whose samples meet them often.
void takeTiny(Film& film, int first) {
    for (int i = first; i < first + 5000; ++i) {
        film.addCoverage(0, 0, 0, i % 2 ? "large" : "/tiny" + std::to_string(i));
        film.addCoverage(0, 0, 0, "/smaller" + std::to_string(i));
        film.addColor(0, 0, glm::vec3(0.5f), 1.0f);
    }
}

TEST(Cryptomatte, IdsThatThereIsNoRoomForAreLeftOut) {
    Film film, roomy, copy;
    cleared(film, 2).limitCoverage(100);
    takeTiny(film, 0);
    EXPECT_EQ(film.coverageNames("cryptoObject").size(), 101u);
    EXPECT_TRUE(film.leftOutCoverage());
    const std::vector<float> values = film.resolve("cryptoObject");
    EXPECT_EQ(values[0], idOf("large"));
    EXPECT_EQ(values[1], 0.5f) << "ids that are there count on";

    take(film, "abcabb", 1);
    EXPECT_EQ(film.resolve("cryptoObject")[12], idOf("b")) << "another pixel has few";
    EXPECT_EQ(film.coverageNames("cryptoObject").size(), 104u);

    takeTiny(cleared(roomy, 2), 0);
    EXPECT_EQ(roomy.coverageNames("cryptoObject").size(), 7501u);
    EXPECT_FALSE(roomy.leftOutCoverage());

    copy.copyFrom(film);
    EXPECT_TRUE(copy.leftOutCoverage());
    takeTiny(copy, 5000);
    EXPECT_EQ(copy.coverageNames("cryptoObject").size(), 104u);
    cleared(copy, 2);
    EXPECT_FALSE(copy.leftOutCoverage());
    takeTiny(copy, 0);
    EXPECT_EQ(copy.coverageNames("cryptoObject").size(), 7501u) << "the room is as at first";
}

TEST(Cryptomatte, FilesCountTheIdsThatTheyAdd) {
    const TempFolder temp;
    Film film, loaded, merged;
    takeTiny(cleared(film, 1), 0);
    film.saveCheckpoint(temp.file("c"));
    loaded.loadCheckpoint(temp.file("c"));
    loaded.limitCoverage(7600);
    takeTiny(loaded, 5000);
    EXPECT_EQ(loaded.coverageNames("cryptoObject").size(), 7601u);

    writePart(temp.file("part"), film);
    cleared(merged, 1).limitCoverage(100);
    mergePartial(merged, temp.file("part"), {});
    EXPECT_EQ(merged.coverageNames("cryptoObject").size(), 101u);
    EXPECT_TRUE(merged.leftOutCoverage());
}

TEST(Cryptomatte, OnlyOpenExrWithAllOfItsBitsHoldsIt) {
    const TempFolder temp;
    Film film;
    take(cleared(film, 1), "ab");
    ImageOptions options;
    options.aovs = {"color", "cryptoObject"};
    EXPECT_TRUE(
        has(reasonOf([&] { writeImage(film, temp.file("a.png"), options); }), "only OpenEXR"));
    options.compression = "dwaa";
    EXPECT_THROW(writeImage(film, temp.file("a.exr"), options), std::runtime_error);
    options.compression = "zip";
    writeImage(film, temp.file("a.exr"), options);
    const ImageData image = readImage(temp.file("a.exr"));
    const std::string key = "cryptomatte/" + hexOf(cryptomatteId("crypto_object")).substr(0, 7);
    EXPECT_EQ(std::get<std::string>(image.metadata.at(key + "/name")), "crypto_object");
    EXPECT_EQ(std::get<std::string>(image.metadata.at(key + "/conversion")), "uint32_to_float32");
}

} // namespace patina

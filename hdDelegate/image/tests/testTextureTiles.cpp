// SPDX-License-Identifier: Apache-2.0
// Textures that are read by tiles show the bits of those that are whole in memory.
#include "hdDelegate/image/tests/imageFixtures.h"
#include "hdDelegate/parallel.h"

#include <limits>
#include <random>

namespace patina {

namespace {

/// Noise over a ramp, so that no two texels of a neighbourhood are equal.
std::vector<float> pattern(int width, int height, int channels, float scale = 1.0f,
                           unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> noise(0.0f, 0.5f);
    std::vector<float> v;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                v.push_back(scale *
                            (0.5f * float(x + (c + 1) * y) / float(width + (c + 1) * height) +
                             noise(random)));
    return v;
}

/// A tiled file with levels of its own, as maketx makes them, but each with noise of its own.
void writeLevels(const std::string& file, int width, int height, int channels, OIIO::TypeDesc type,
                 int levels) {
    auto out = OIIO::ImageOutput::create(file);
    ASSERT_TRUE(out) << OIIO::geterror();
    for (int level = 0; level < levels; ++level) {
        const int w = std::max(1, width >> level), h = std::max(1, height >> level);
        OIIO::ImageSpec spec = specOf(w, h, channels, type);
        spec.tile_width = spec.tile_height = 64;
        spec.attribute("textureformat", "Plain Texture");
        spec.attribute("openexr:levelmode", 1);
        spec.attribute("openexr:roundingmode", 0);
        ASSERT_TRUE(out->open(file, spec,
                              level ? out->supports("mipmap") ? OIIO::ImageOutput::AppendMIPLevel
                                                              : OIIO::ImageOutput::AppendSubimage
                                    : OIIO::ImageOutput::Create))
            << file << out->geterror();
        const auto values = pattern(w, h, channels, 1.0f, unsigned(level) + 7);
        ASSERT_TRUE(out->write_image(OIIO::TypeFloat, values.data())) << out->geterror();
    }
    ASSERT_TRUE(out->close());
}

struct Lookup {
    glm::vec2 uv;
    float footprint;
};

/// Random places in and around the unit square, and edges of texels and tiles; all sizes of
/// filters.
std::vector<Lookup> lookups(int count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-1.5f, 2.5f), power(-12.0f, 1.0f);
    std::vector<Lookup> list;
    for (int i = 0; i < count; ++i)
        list.push_back({{place(random), place(random)}, i % 4 ? std::exp2(power(random)) : 0.0f});
    for (float edge : {0.0f, 1.0f, 0.5f, -1.0f, 64.0f / 201.0f})
        for (float footprint : {0.0f, 0.02f, 0.1f, 3.0f})
            list.push_back({{edge, 1.0f - edge}, footprint});
    list.push_back({{std::numeric_limits<float>::quiet_NaN(), 0.3f}, 0.0f});
    return list;
}

bool sameBits(const glm::vec4& a, const glm::vec4& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

class TextureTiles : public ::testing::Test {
protected:
    TempFolder temp;
    Diagnostics diagnostics, ofTiles;
    TextureSystem whole{diagnostics}, tiled{ofTiles};

    /// Filtered and not, all wrap modes; `mixed`: in all pairs.
    void expectSame(const std::string& file, const std::string& space = "auto",
                    bool mixed = false) {
        tiled.setMemory(40000); // OpenImageIO's part is larger, and fixed
        const auto list = lookups(20);
        for (int s = 0; s < 4; ++s)
            for (int t = mixed ? 0 : s; t < (mixed ? 4 : s + 1); ++t)
                for (bool nearest : {false, true}) {
                    TextureRequest r = requestOf(file, space);
                    r.wrapS = TextureWrap(s);
                    r.wrapT = TextureWrap(t);
                    r.nearest = nearest;
                    const int a = whole.open(r), b = tiled.open(r);
                    ASSERT_TRUE(whole.valid(a) && tiled.valid(b)) << file;
                    int different = 0;
                    for (const Lookup& l : list)
                        different += !sameBits(whole.sample(a, l.uv, l.footprint),
                                               tiled.sample(b, l.uv, l.footprint));
                    EXPECT_EQ(different, 0) << file << ' ' << space << ' ' << s << t << nearest;
                }
        EXPECT_GT(tiled.memory().counts().tilesMade, 0u) << file;
        EXPECT_EQ(tiled.memory().counts().whole, 0u) << file;
        EXPECT_EQ(whole.memory().counts().tilesMade, 0u) << file;
    }
    /// A file of noise over a ramp. @returns its path
    std::string write(const std::string& name, int width, int height, int channels,
                      OIIO::TypeDesc type, float scale = 1.0f, unsigned seed = 1) {
        writeImage(temp.file(name), specOf(width, height, channels, type),
                   pattern(width, height, channels, scale, seed));
        return temp.file(name);
    }
    void expectSame(const std::string& name, int width, int height, int channels,
                    OIIO::TypeDesc type, const std::string& space = "auto", float scale = 1.0f) {
        if (!std::filesystem::exists(temp.file(name)))
            write(name, width, height, channels, type, scale);
        expectSame(temp.file(name), space);
    }
};

} // namespace

TEST_F(TextureTiles, EightBitFiles) {
    for (int channels = 1; channels <= 4; ++channels)
        expectSame("eight" + std::to_string(channels) + ".png", 201, 131, channels,
                   OIIO::TypeUInt8);
    expectSame(temp.file("eight3.png"), "raw", true);
    expectSame("square.png", 256, 256, 3, OIIO::TypeUInt8);
    expectSame("alpha.tif", 201, 131, 4, OIIO::TypeUInt8);
    expectSame("photo.jpg", 201, 131, 3, OIIO::TypeUInt8);
    expectSame("column.png", 3, 9000, 3, OIIO::TypeUInt8);
    expectSame("row.png", 9000, 2, 3, OIIO::TypeUInt8);
    EXPECT_EQ(ofTiles.count(), 0);
}

TEST_F(TextureTiles, DeepFiles) {
    expectSame("deep.png", 201, 131, 3, OIIO::TypeUInt16);
    expectSame("half.exr", 201, 131, 4, OIIO::TypeHalf);
    expectSame("float.exr", 150, 131, 3, OIIO::TypeFloat, "auto", 100.0f);
    expectSame("one.exr", 201, 131, 1, OIIO::TypeFloat);
    expectSame("sky.hdr", 201, 131, 3, OIIO::TypeFloat, "auto", 30.0f);
    expectSame("sun.hdr", 150, 131, 3, OIIO::TypeFloat, "auto", 1e6f);
    EXPECT_EQ(ofTiles.count(), 0);
}

TEST_F(TextureTiles, ColourSpaces) {
    for (const char* space : {"raw", "sRGB", "g22_rec709", "acescg"}) {
        expectSame("a.png", 150, 131, 3, OIIO::TypeUInt8, space);
        expectSame("alpha.png", 150, 131, 4, OIIO::TypeUInt8, space);
        expectSame("grey.png", 201, 131, 1, OIIO::TypeUInt8, space);
        expectSame("deep.png", 150, 131, 3, OIIO::TypeUInt16, space);
        expectSame("half.exr", 150, 131, 3, OIIO::TypeHalf, space);
    }
}

TEST_F(TextureTiles, GreyThatIsSavedAsColour) {
    std::vector<float> grey = pattern(201, 131, 1), values;
    for (float v : grey)
        values.insert(values.end(), {v, v, v});
    writeImage(temp.file("grey.png"), specOf(201, 131, 3, OIIO::TypeUInt8), values);
    expectSame(temp.file("grey.png"));
    EXPECT_EQ(whole.image(0)->channels(), 1);
}

TEST_F(TextureTiles, DataWindowsThatBeginElsewhere) {
    OIIO::ImageSpec spec = specOf(201, 131, 3, OIIO::TypeHalf);
    spec.x = -20;
    spec.y = 33;
    writeImage(temp.file("window.exr"), spec, pattern(201, 131, 3));
    expectSame(temp.file("window.exr"));
}

TEST_F(TextureTiles, LevelsOfTheFileAreUsedAsTheyAre) {
    struct {
        const char* file;
        int width, height, channels, levels;
        OIIO::TypeDesc type;
    } cases[] = {{"all.tx", 256, 128, 3, 9, OIIO::TypeUInt8},
                 {"some.tx", 256, 128, 3, 3, OIIO::TypeUInt8},
                 {"odd.tx", 201, 131, 4, 8, OIIO::TypeUInt16},
                 {"all.exr", 256, 256, 3, 9, OIIO::TypeHalf},
                 {"odd.exr", 201, 131, 1, 8, OIIO::TypeFloat}};
    for (auto& k : cases) {
        const std::string path = temp.file(k.file);
        const bool tx = path.substr(path.size() - 3) == ".tx";
        const std::string name = tx ? path.substr(0, path.size() - 3) + ".tif" : path;
        writeLevels(name, k.width, k.height, k.channels, k.type, k.levels);
        if (HasFatalFailure()) return;
        if (tx) std::filesystem::rename(name, path);
        expectSame(path);
        // The values of each level are the file's; below them averages of its last.
        const int handle = whole.open(requestOf(path, "raw"));
        const auto image = whole.image(handle);
        for (int level = 0; level < k.levels; ++level) {
            const float expected =
                pattern(image->levels()[size_t(level)].width, image->levels()[size_t(level)].height,
                        k.channels, 1.0f, unsigned(level) + 7)[0];
            EXPECT_NEAR(image->texel(level, 0, 0).r, expected, 0.5 / 255 + 1e-3) << path << level;
        }
    }
}

TEST_F(TextureTiles, UdimTiles) {
    for (int tile : {1001, 1002, 1012})
        write("u." + std::to_string(tile) + ".png", 150, 150, 3, OIIO::TypeUInt8, 1.0f,
              unsigned(tile));
    tiled.setMemory(40000);
    const int a = whole.open(requestOf(temp.file("u.<UDIM>.png")));
    const int b = tiled.open(requestOf(temp.file("u.<UDIM>.png")));
    for (const Lookup& l : lookups(200))
        EXPECT_TRUE(
            sameBits(whole.sample(a, l.uv, l.footprint), tiled.sample(b, l.uv, l.footprint)));
    EXPECT_GT(tiled.memory().counts().tilesMade, 0u);
}

TEST_F(TextureTiles, BitsDependNeitherOnThreadsNorOnWhatMadeRoom) {
    std::vector<std::string> files;
    for (int i = 0; i < 6; ++i)
        files.push_back(
            write(std::to_string(i) + ".exr", 520, 390, 3, OIIO::TypeHalf, 1.0f, unsigned(i)));
    const auto list = lookups(500);
    tiled.setMemory(size_t(1) << 20); // of eight
    std::vector<int> a, b;
    for (const std::string& file : files) {
        a.push_back(whole.open(requestOf(file)));
        b.push_back(tiled.open(requestOf(file)));
    }
    std::atomic<int> different{0};
    parallelFor(size_t(0), list.size(), [&](size_t i) {
        const size_t k = i * 7 % 6;
        different += !sameBits(whole.sample(a[k], list[i].uv, list[i].footprint),
                               tiled.sample(b[k], list[i].uv, list[i].footprint));
    });
    EXPECT_EQ(different, 0);
    const TextureMemory::Counts counts = tiled.memory().counts();
    EXPECT_GT(counts.tilesMade, 6u * 97u) << "some were made again";
    EXPECT_LE(counts.tilesPeak, counts.capacity);
    EXPECT_LE(counts.capacity, size_t(1) << 20);
}

TEST_F(TextureTiles, WhatFitsIsWholeAndTheRestIsNot) {
    const std::string small = write("a.png", 200, 200, 3, OIIO::TypeUInt8),
                      large = write("b.png", 400, 400, 3, OIIO::TypeUInt8);
    tiled.setMemory(300000); // a takes 160,000, b 640,000
    const int a = tiled.open(requestOf(small));
    tiled.sample(a, {0.5f, 0.5f}, 0.0f);
    EXPECT_EQ(tiled.memory().counts().capacity, 0u);
    const int b = tiled.open(requestOf(large));
    tiled.sample(b, {0.5f, 0.5f}, 0.0f);
    const TextureMemory::Counts counts = tiled.memory().counts();
    EXPECT_GT(counts.whole, 150000u);
    EXPECT_GT(counts.capacity, 0u);
    EXPECT_LE(counts.whole + counts.capacity, 300000u);
    // Who needs all texels has them, for as long as they are held.
    EXPECT_TRUE(tiled.image(b)->isWhole());
    EXPECT_EQ(tiled.image(b)->width(), 400);
}

TEST_F(TextureTiles, NotANumber) {
    std::vector<float> values = pattern(201, 131, 3);
    values[300] = std::numeric_limits<float>::quiet_NaN();
    values[values.size() - 4] = std::numeric_limits<float>::infinity();
    writeImage(temp.file("nan.exr"), specOf(201, 131, 3, OIIO::TypeFloat), values);
    expectSame(temp.file("nan.exr"));
    EXPECT_TRUE(has(onlyMessage(ofTiles), "holds values that are NaN"));
}

TEST_F(TextureTiles, ADamagedPartIsMagentaAndIsWarnedOf) {
    for (const char* name : {"bad.exr", "bad.tif"}) {
        const std::string file = temp.file(name);
        OIIO::ImageSpec spec = specOf(256, 256, 3, OIIO::TypeHalf);
        if (file.back() == 'f') spec.format = OIIO::TypeUInt16;
        spec.tile_width = spec.tile_height = 64;
        spec.attribute("compression", "zip");
        writeImage(file, spec, pattern(256, 256, 3));
        {
            std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
            bytes.seekp(std::streamoff(std::filesystem::file_size(file) / 2));
            bytes.write(std::string(64, '\xff').data(), 64);
        }
        Diagnostics warned;
        TextureSystem textures{warned};
        textures.setMemory(40000);
        const int handle = textures.open(requestOf(file));
        int bad = 0;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x)
                bad += textures.sample(handle, {(float(x) + 0.5f) / 4, (float(y) + 0.5f) / 4},
                                       0.0f) == magenta;
        EXPECT_EQ(bad, 1) << name;
        EXPECT_EQ(textures.sample(handle, {0.5f, 0.5f}, 9.0f), magenta) << name;
        const std::string told = onlyWarning(warned);
        EXPECT_TRUE(has(told, "/Material/texture ") &&
                    has(told, "magenta is shown where it cannot be read"))
            << told;
    }
}

TEST_F(TextureTiles, AFileThatVanishesOrShrinks) {
    for (bool gone : {true, false}) {
        const std::string file = write("gone.png", 300, 300, 3, OIIO::TypeUInt8);
        Diagnostics warned;
        TextureSystem textures{warned};
        textures.setMemory(40000);
        const int handle = textures.open(requestOf(file));
        ASSERT_TRUE(textures.valid(handle));
        if (gone)
            std::filesystem::remove(file);
        else
            std::filesystem::resize_file(file, 100);
        EXPECT_EQ(textures.sample(handle, {0.5f, 0.5f}, 0.0f), magenta);
        EXPECT_TRUE(has(onlyMessage(warned), "magenta is shown"));
    }
}

} // namespace patina

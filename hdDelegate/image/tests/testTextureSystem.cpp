// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/tests/tempFolder.h"
#include "hdDelegate/image/iesProfile.h"
#include "hdDelegate/image/textureSystem.h"
#include "hdDelegate/parallel.h"
#include "base/limits.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

namespace patina {

namespace {

float srgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

/// Writes a constant image of any format; channels are repeated over all pixels.
void writeImage(const std::string& file, int width, int height, std::vector<float> channels,
                OIIO::TypeDesc type, std::vector<std::string> names = {}) {
    OIIO::ImageSpec spec(width, height, int(channels.size()), type);
    if (!names.empty()) spec.channelnames = names;
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", 100);
    auto out = OIIO::ImageOutput::create(file);
    ASSERT_TRUE(out && out->open(file, spec)) << file << OIIO::geterror();
    std::vector<float> pixels;
    for (int i = 0; i < width * height; ++i)
        pixels.insert(pixels.end(), channels.begin(), channels.end());
    ASSERT_TRUE(out->write_image(OIIO::TypeFloat, pixels.data())) << out->geterror();
    ASSERT_TRUE(out->close());
}

class Textures : public ::testing::Test {
protected:
    TempFolder temp;
    Diagnostics diagnostics;
    TextureSystem textures{diagnostics};

    int open(const std::string& file, const std::string& colorSpace = "auto") {
        TextureRequest request;
        request.file = file;
        request.colorSpace = colorSpace;
        request.prim = "/Material/texture";
        request.input = "inputs:file";
        return textures.open(request);
    }
    glm::vec4 middle(int handle) { return textures.sample(handle, {0.5f, 0.5f}, 0.0f); }
    void expectMiddle(int handle, glm::vec4 expected, float tolerance, const std::string& what) {
        glm::vec4 c = middle(handle);
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(c[i], expected[i], tolerance) << what << ", channel " << i;
    }
    std::string onlyMessage() {
        EXPECT_EQ(diagnostics.count(), 1);
        if (diagnostics.count() < 1) return "";
        Diagnostic d = diagnostics.all()[0];
        return d.prim + " " + d.input + " " + d.message;
    }
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

const glm::vec4 magenta(1, 0, 1, 1);

} // namespace

TEST_F(Textures, EightBitFlavoursWithTheColourSpaceThatAutoMeans) {
    const float a = 51 / 255.0f, b = 102 / 255.0f, c = 204 / 255.0f, d = 153 / 255.0f;
    struct {
        const char* file;
        std::vector<float> channels;
        glm::vec4 expected;
    } cases[] = {
        {"grey.png", {b}, {b, b, b, 1}},
        {"greyAlpha.png", {b, d}, {b, b, b, d}},
        {"rgb.png", {a, b, c}, {srgb(a), srgb(b), srgb(c), 1}},
        {"rgba.png", {a, b, c, d}, {srgb(a), srgb(b), srgb(c), d}},
        {"rgb.tga", {a, b, c}, {srgb(a), srgb(b), srgb(c), 1}},
        {"rgba.tga", {a, b, c, d}, {srgb(a), srgb(b), srgb(c), d}},
        {"rgb.tif", {a, b, c}, {srgb(a), srgb(b), srgb(c), 1}},
        {"rgba.tif", {a, b, c, d}, {srgb(a), srgb(b), srgb(c), d}},
        {"rgb.bmp", {a, b, c}, {srgb(a), srgb(b), srgb(c), 1}},
    };
    for (auto& k : cases) {
        writeImage(temp.file(k.file), 5, 3, k.channels, OIIO::TypeUInt8);
        int handle = open(temp.file(k.file));
        EXPECT_TRUE(textures.valid(handle)) << k.file;
        EXPECT_EQ(textures.channels(handle), int(k.channels.size())) << k.file;
        expectMiddle(handle, k.expected, 2e-6f, k.file);
        EXPECT_EQ(textures.image(handle)->type(), TexelType::U8) << k.file;
    }
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST_F(Textures, JpegWithOneAndThreeChannels) {
    writeImage(temp.file("rgb.jpg"), 16, 16, {0.2f, 0.4f, 0.8f}, OIIO::TypeUInt8);
    writeImage(temp.file("grey.jpg"), 16, 16, {0.4f}, OIIO::TypeUInt8);
    expectMiddle(open(temp.file("rgb.jpg")), {srgb(0.2f), srgb(0.4f), srgb(0.8f), 1}, 0.012f,
                 "rgb");
    expectMiddle(open(temp.file("grey.jpg")), {0.4f, 0.4f, 0.4f, 1}, 0.005f, "grey");
    EXPECT_EQ(textures.channels(open(temp.file("grey.jpg"))), 1);
}

TEST_F(Textures, DeepFlavoursAreDataUnderAuto) {
    struct {
        const char* file;
        OIIO::TypeDesc type;
        float tolerance;
        TexelType stored;
    } cases[] = {{"deep.png", OIIO::TypeUInt16, 1e-5f, TexelType::U16},
                 {"deep.tif", OIIO::TypeUInt16, 1e-5f, TexelType::U16},
                 {"float.tif", OIIO::TypeFloat, 0, TexelType::Float},
                 {"float.exr", OIIO::TypeFloat, 0, TexelType::Float},
                 {"half.exr", OIIO::TypeHalf, 2e-4f, TexelType::Half}};
    for (auto& k : cases) {
        writeImage(temp.file(k.file), 3, 3, {0.1f, 0.5f, 0.9f, 0.3f}, k.type);
        int handle = open(temp.file(k.file));
        expectMiddle(handle, {0.1f, 0.5f, 0.9f, 0.3f}, k.tolerance, k.file);
        EXPECT_EQ(textures.image(handle)->type(), k.stored) << k.file;
    }
    writeImage(temp.file("sky.hdr"), 16, 8, {3.0f, 0.5f, 12.0f}, OIIO::TypeFloat);
    expectMiddle(open(temp.file("sky.hdr")), {3, 0.5f, 12, 1}, 0.06f, "sky.hdr");
    EXPECT_EQ(textures.image(open(temp.file("sky.hdr")))->type(), TexelType::Half);
    writeImage(temp.file("sun.hdr"), 16, 8, {3e6f, 0.5f, 12.0f}, OIIO::TypeFloat);
    EXPECT_NEAR(middle(open(temp.file("sun.hdr"))).r, 3e6f, 2e4f) << "half would clip the sun";
}

TEST_F(Textures, ExplicitColourSpaces) {
    writeImage(temp.file("a.png"), 2, 2, {0.2f, 0.4f, 0.8f}, OIIO::TypeUInt8);
    writeImage(temp.file("deep.png"), 2, 2, {0.2f, 0.4f, 0.8f}, OIIO::TypeUInt16);
    for (const char* file : {"a.png", "deep.png"}) {
        std::string path = temp.file(file);
        expectMiddle(open(path, "raw"), {0.2f, 0.4f, 0.8f, 1}, 1e-5f, "raw");
        expectMiddle(open(path, "sRGB"), {srgb(0.2f), srgb(0.4f), srgb(0.8f), 1}, 1e-5f, "sRGB");
        expectMiddle(open(path, "g22_rec709"),
                     {std::pow(0.2f, 2.2f), std::pow(0.4f, 2.2f), std::pow(0.8f, 2.2f), 1}, 1e-5f,
                     "g22");
        glm::vec3 wide(0.2f, 0.4f, 0.8f);
        ColorSpaces::shared().toRec709("acescg")->apply(&wide.x, 1, 3);
        expectMiddle(open(path, "acescg"), glm::vec4(wide, 1), 5e-4f, "acescg");
    }
    EXPECT_EQ(textures.image(open(temp.file("a.png"), "acescg"))->type(), TexelType::Half)
        << "a matrix cannot be a table of one channel";
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST_F(Textures, AnUnknownColourSpaceIsNamedAndTakenAsData) {
    writeImage(temp.file("a.png"), 2, 2, {0.2f, 0.4f, 0.8f}, OIIO::TypeUInt8);
    expectMiddle(open(temp.file("a.png"), "kodachrome"), {0.2f, 0.4f, 0.8f, 1}, 1e-6f, "raw");
    std::string message = onlyMessage();
    EXPECT_TRUE(has(message, "kodachrome") && has(message, "/Material/texture") &&
                has(message, "inputs:file") && has(message, "a.png"))
        << message;
}

TEST_F(Textures, MissingFileIsMagentaWithOneWarningThatNamesAll) {
    int handle = open(temp.file("gone.png"));
    EXPECT_FALSE(textures.valid(handle));
    EXPECT_EQ(middle(handle), magenta);
    EXPECT_EQ(open(temp.file("gone.png")), handle);
    std::string message = onlyMessage();
    EXPECT_TRUE(has(message, "/Material/texture") && has(message, "inputs:file") &&
                has(message, "gone.png"))
        << message;
    EXPECT_FALSE(textures.valid(-1));
    EXPECT_FALSE(textures.valid(99));
    EXPECT_EQ(middle(99), magenta);
}

TEST_F(Textures, DamagedFilesAreMagentaWithAWarning) {
    std::ofstream(temp.file("text.png")) << "this is no image";
    std::ofstream(temp.file("empty.exr"));
    EXPECT_FALSE(textures.valid(open(temp.file("text.png"))));
    EXPECT_FALSE(textures.valid(open(temp.file("empty.exr"))));
    EXPECT_FALSE(textures.valid(open(temp.path().string())));
    EXPECT_FALSE(textures.valid(open("")));
    EXPECT_EQ(diagnostics.count(), 4);
    for (const char* name : {"cut.png", "cut.exr", "cut.tif"}) {
        OIIO::ImageSpec spec(64, 64, 3, OIIO::TypeFloat);
        std::vector<float> noise(64 * 64 * 3);
        for (size_t i = 0; i < noise.size(); ++i)
            noise[i] = float((i * 7919) % 1000) / 1000.0f;
        auto out = OIIO::ImageOutput::create(temp.file(name));
        ASSERT_TRUE(out->open(temp.file(name), spec));
        out->write_image(OIIO::TypeFloat, noise.data());
        out->close();
        auto size = std::filesystem::file_size(temp.file(name));
        std::filesystem::resize_file(temp.file(name), size / 2);
        int before = diagnostics.count();
        EXPECT_EQ(middle(open(temp.file(name))), magenta) << name;
        EXPECT_GT(diagnostics.count(), before) << name;
    }
}

TEST_F(Textures, NotFiniteTexelsBecomeBlackWithAWarning) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    for (auto type : {OIIO::TypeFloat, OIIO::TypeHalf}) {
        std::string file = temp.file(type == OIIO::TypeHalf ? "half.exr" : "float.exr");
        writeImage(file, 2, 2, {nan, 0.5f, inf}, type);
        expectMiddle(open(file), {0, 0.5f, 0, 1}, 1e-6f, file);
    }
    EXPECT_EQ(diagnostics.count(), 2);
    EXPECT_TRUE(has(diagnostics.all()[0].message, "8 values")) << diagnostics.all()[0].message;
}

TEST_F(Textures, TexelsThatColourSpacesMakeInfiniteBecomeBlackWithAWarning) {
    writeImage(temp.file("bright.exr"), 2, 2, {1e17f, 0.5f, 0.5f}, OIIO::TypeFloat);
    const int handle = open(temp.file("bright.exr"), "srgb_texture");
    const glm::vec4 found = textures.sample(handle, {0.5f, 0.5f}, 0);
    EXPECT_EQ(found.x, 0.0f);
    EXPECT_NEAR(found.y, 0.214f, 1e-3f);
    EXPECT_TRUE(has(onlyMessage(), "4 values")) << onlyMessage();
}

TEST_F(Textures, ImagesWithSidesBeyondNumbersAreNone) {
    // A header alone: a strip of tiles that would unpack to 600 MB.
    OIIO::ImageSpec spec(300000000, 1, 1, OIIO::TypeHalf);
    spec.tile_width = 1 << 16;
    spec.tile_height = 1;
    const std::string file = temp.file("long.exr");
    auto output = OIIO::ImageOutput::create(file);
    ASSERT_TRUE(output && output->open(file, spec)) << output->geterror();
    output->close();
    const int handle = open(file);
    textures.loadAll();
    EXPECT_EQ(textures.sample(handle, {0.0f, 0.5f}, 0), magenta);
    EXPECT_TRUE(has(onlyMessage(), "300000000x1x1 is not a texture")) << onlyMessage();
}

TEST_F(Textures, NamesOfVeryManyTilesHaveNone) {
    std::string name = temp.file("");
    for (int i = 0; i < 170000; ++i)
        name += "<UDIM>";
    EXPECT_FALSE(textures.valid(open(name)));
}

TEST_F(Textures, ImagesOfLightsAreWithinALimit) {
    writeImage(temp.file("grey.png"), 600, 600, {0.5f},
               OIIO::TypeUInt8); // 360 kB, 4.3 MB as floats
    const auto load = [&] {
        return loadImageLinear({temp.file("grey.png"), "auto", "/Rect", "texture"}, diagnostics)
            .valid;
    };
    setLimits({{"textureBytes", 1000000}});
    EXPECT_FALSE(load());
    setLimits({});
    EXPECT_TRUE(has(onlyMessage(), "--limit textureBytes")) << onlyMessage();
    EXPECT_TRUE(load());
}

TEST_F(Textures, ImagesOfLightsAreAsTheirFilesSay) {
    writeImage(temp.file("half.png"), 1, 1, {0.5f, 0.5f, 0.5f}, OIIO::TypeUInt8);
    const auto load = [&](const char* space) {
        return loadImageLinear({temp.file("half.png"), space, "/Rect", "texture"}, diagnostics)
            .pixels.at(0)
            .x;
    };
    EXPECT_NEAR(load(""), 0.2159f, 1e-3f); // eight bits of colour are sRGB
    EXPECT_NEAR(load("raw"), 0.502f, 1e-3f);
}

TEST_F(Textures, ChannelsBeyondFourAndTwoColourChannels) {
    writeImage(temp.file("many.exr"), 2, 2, {0.1f, 0.2f, 0.3f, 0.4f, 0.5f}, OIIO::TypeFloat,
               {"R", "G", "B", "X", "Y"});
    EXPECT_EQ(textures.channels(open(temp.file("many.exr"))), 3);
    expectMiddle(open(temp.file("many.exr")), {0.1f, 0.2f, 0.3f, 1}, 1e-6f, "many");
    writeImage(temp.file("rg.exr"), 2, 2, {0.1f, 0.2f}, OIIO::TypeFloat, {"R", "G"});
    expectMiddle(open(temp.file("rg.exr")), {0.1f, 0.2f, 0, 1}, 1e-6f, "rg");
}

TEST_F(Textures, StraightAlphaIsNotMultipliedIn) {
    writeImage(temp.file("glass.png"), 2, 2, {0.8f, 0.6f, 0.4f, 0.0f}, OIIO::TypeUInt8);
    expectMiddle(open(temp.file("glass.png"), "raw"), {0.8f, 0.6f, 0.4f, 0}, 1e-6f, "glass");
}

TEST_F(Textures, UdimTiles) {
    writeImage(temp.file("t.1001.png"), 4, 4, {1, 0, 0}, OIIO::TypeUInt8);
    writeImage(temp.file("t.1002.png"), 4, 4, {0, 1, 0}, OIIO::TypeUInt8);
    writeImage(temp.file("t.1011.png"), 4, 4, {0, 0, 1}, OIIO::TypeUInt8);
    writeImage(temp.file("t.10x1.png"), 4, 4, {1, 1, 1}, OIIO::TypeUInt8);
    int handle = open(temp.file("t.<UDIM>.png"));
    ASSERT_TRUE(textures.valid(handle));
    EXPECT_EQ(textures.sample(handle, {0.5f, 0.5f}, 0), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(textures.sample(handle, {1.5f, 0.5f}, 0), glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(textures.sample(handle, {0.5f, 1.5f}, 0), glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(textures.sample(handle, {0.999f, 0.5f}, 0), glm::vec4(1, 0, 0, 1)) << "no bleeding";
    EXPECT_EQ(textures.sample(handle, {2.0f, 0.5f}, 0), glm::vec4(0, 1, 0, 1)) << "the far edge";
    EXPECT_EQ(textures.sample(handle, {1.0f, 2.0f}, 0), glm::vec4(0, 0, 1, 1)) << "the far corner";
    EXPECT_EQ(diagnostics.count(), 0);
    EXPECT_EQ(textures.sample(handle, {1.5f, 1.5f}, 0), magenta);
    EXPECT_EQ(textures.sample(handle, {1.6f, 1.6f}, 0), magenta);
    EXPECT_EQ(diagnostics.count(), 1);
    EXPECT_TRUE(has(diagnostics.all()[0].message, "1012"));
    EXPECT_EQ(textures.sample(handle, {-0.5f, 0.5f}, 0), magenta);
    EXPECT_EQ(textures.sample(handle, {10.5f, 0.5f}, 0), magenta);
    EXPECT_EQ(textures.sample(handle, {1e30f, -1e30f}, 0), magenta);
    EXPECT_EQ(diagnostics.count(), 2);
    EXPECT_FALSE(textures.valid(open(temp.file("none.<UDIM>.png"))));
    writeImage(temp.file("m_u1_v2.png"), 4, 4, {0, 0, 1}, OIIO::TypeUInt8);
    handle = open(temp.file("m_<UVTILE>.png")); // as Mudbox names tiles
    EXPECT_EQ(textures.sample(handle, {0.5f, 1.5f}, 0), glm::vec4(0, 0, 1, 1));
}

TEST_F(Textures, EqualRequestsShareAHandleAndDifferentOnesThePixels) {
    writeImage(temp.file("a.png"), 8, 8, {0.2f, 0.4f, 0.8f}, OIIO::TypeUInt8);
    TextureRequest request;
    request.file = temp.file("a.png");
    request.colorSpace = "sRGB";
    int repeat = textures.open(request);
    request.prim = "/Another/material";
    EXPECT_EQ(textures.open(request), repeat);
    request.wrapS = TextureWrap::Clamp;
    int clamp = textures.open(request);
    request.nearest = true;
    EXPECT_NE(clamp, repeat);
    EXPECT_NE(textures.open(request), clamp);
    EXPECT_EQ(textures.memoryBytes(), 0u) << "nothing is read before it is needed";
    EXPECT_EQ(textures.image(repeat), textures.image(clamp));
    EXPECT_EQ(textures.memoryBytes(), size_t(64 + 16 + 4 + 1) * 3);
}

TEST_F(Textures, ManyThreadsMayBeTheFirstToSample) {
    std::vector<int> handles;
    for (int i = 0; i < 16; ++i) {
        std::string file = temp.file("t" + std::to_string(i) + ".png");
        writeImage(file, 128, 128, {float(i) / 255.0f}, OIIO::TypeUInt8);
        handles.push_back(open(file));
    }
    parallelFor(0, 4096, [&](int i) {
        int which = i % 16;
        float r = textures.sample(handles[size_t(which)], {0.3f, 0.3f}, 0.0f).r;
        EXPECT_NEAR(r, float(which) / 255.0f, 1e-6f);
    });
    textures.loadAll();
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST_F(Textures, TheFinestLevelAloneHasNoWiderFilters) {
    OIIO::ImageSpec spec(4, 1, 1, OIIO::TypeUInt8);
    auto out = OIIO::ImageOutput::create(temp.file("edge.png"));
    const float pixels[] = {0, 1, 0, 1};
    ASSERT_TRUE(out && out->open(temp.file("edge.png"), spec));
    ASSERT_TRUE(out->write_image(OIIO::TypeFloat, pixels) && out->close());
    TextureSystem finest(diagnostics);
    finest.sampleFinestOnly();
    TextureRequest request;
    request.file = temp.file("edge.png");
    request.colorSpace = "raw";
    const glm::vec2 texel(0.375f, 0.5f);
    EXPECT_EQ(finest.sample(finest.open(request), texel, 1.0f).r, 1.0f);
    // Coarser levels of images of eight bits have eight bits.
    EXPECT_NEAR(textures.sample(textures.open(request), texel, 1.0f).r, 0.5f, 1.0f / 255.0f);
}

TEST_F(Textures, LinearImagesForLights) {
    writeImage(temp.file("sky.exr"), 4, 2, {0.1f, 5.0f, 0.3f}, OIIO::TypeFloat);
    ImageRGB image = loadImageLinear({temp.file("sky.exr"), "auto", "/Dome", "texture"}, diagnostics);
    EXPECT_TRUE(image.valid);
    EXPECT_EQ(image.width * 100 + image.height, 402);
    EXPECT_EQ(image.pixels.size(), 8u);
    EXPECT_EQ(image.pixels[7], glm::vec3(0.1f, 5.0f, 0.3f));
    image = loadImageLinear({temp.file("no.exr"), "auto", "/Dome", "texture"}, diagnostics);
    EXPECT_FALSE(image.valid);
    EXPECT_EQ(image.pixels.at(0), glm::vec3(1, 0, 1));
    EXPECT_TRUE(has(onlyMessage(), "/Dome"));
}

// A profile that falls with the cosine: its mean over the hemisphere is half of its peak, so the
// factor is 2 cos. The table is linear between every 5 degrees.
TEST_F(Textures, ReadsIesProfiles) {
    const std::string file = temp.file("lamp.ies");
    {
        std::ofstream out(file);
        out << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 19 1 1 2 0 0 0\n1 1 100\n";
        for (int i = 0; i <= 90; i += 5)
            out << i << ' ';
        out << "\n0\n";
        for (int i = 0; i <= 90; i += 5)
            out << 700.0 * std::cos(i * 0.017453292519943295) << ' ';
        out << '\n';
    }
    TextureRequest request;
    request.file = file;
    request.prim = "/Material/edf";
    request.input = "file";
    const auto profile = textures.openProfile(request);
    ASSERT_TRUE(profile);
    EXPECT_EQ(profile, textures.openProfile(request));
    for (float theta : {0.0f, 0.4f, 1.0f, 1.5f})
        EXPECT_NEAR(profile->factor(theta, 2.0f), 2.0f * std::cos(theta), 6e-3f) << theta;
    EXPECT_EQ(profile->factor(1.7f, 0.0f), 0.0f);

    request.file = temp.file("missing.ies");
    EXPECT_FALSE(textures.openProfile(request));
    EXPECT_FALSE(textures.openProfile(request)); // says so once
    EXPECT_NE(onlyMessage().find("it emits the same everywhere"), std::string::npos);
}

} // namespace patina

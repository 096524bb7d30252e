// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/iesProfile.h"
#include "hdDelegate/image/tests/imageFixtures.h"
#include "hdDelegate/parallel.h"
#include "base/limits.h"

#include <limits>

namespace patina {

namespace {

class Textures : public TextureTest {
protected:
    void expectMiddle(int handle, glm::vec4 expected, float tolerance, const std::string& what) {
        glm::vec4 c = middle(handle);
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(c[i], expected[i], tolerance) << what << ", channel " << i;
    }
    /// Writes a constant image of so many pixels along each side. @returns its path
    std::string constant(const std::string& name, int side, const std::vector<float>& channels,
                         OIIO::TypeDesc type = OIIO::TypeUInt8, const Tag& tag = {}) {
        writeConstant(temp.file(name), side, side, channels, type, tag);
        return temp.file(name);
    }
    void expectSample(int handle, glm::vec2 uv, const glm::vec4& expected) {
        EXPECT_EQ(textures.sample(handle, uv, 0), expected) << uv.x << " " << uv.y;
    }
};

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
        int handle = open(constant(k.file, 5, k.channels));
        EXPECT_TRUE(textures.valid(handle)) << k.file;
        EXPECT_EQ(textures.channels(handle), int(k.channels.size())) << k.file;
        expectMiddle(handle, k.expected, 2e-6f, k.file);
        EXPECT_EQ(textures.image(handle)->type(), TexelType::U8) << k.file;
    }
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST_F(Textures, JpegWithOneAndThreeChannels) {
    expectMiddle(open(constant("rgb.jpg", 16, {0.2f, 0.4f, 0.8f})),
                 {srgb(0.2f), srgb(0.4f), srgb(0.8f), 1}, 0.012f, "rgb");
    const int grey = open(constant("grey.jpg", 16, {0.4f}));
    expectMiddle(grey, {0.4f, 0.4f, 0.4f, 1}, 0.005f, "grey");
    EXPECT_EQ(textures.channels(grey), 1);
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
        int handle = open(constant(k.file, 3, {0.1f, 0.5f, 0.9f, 0.3f}, k.type));
        expectMiddle(handle, {0.1f, 0.5f, 0.9f, 0.3f}, k.tolerance, k.file);
        EXPECT_EQ(textures.image(handle)->type(), k.stored) << k.file;
    }
    const int sky = open(constant("sky.hdr", 16, {3.0f, 0.5f, 12.0f}, OIIO::TypeFloat));
    expectMiddle(sky, {3, 0.5f, 12, 1}, 0.06f, "sky.hdr");
    EXPECT_EQ(textures.image(sky)->type(), TexelType::Half);
    const int sun = open(constant("sun.hdr", 16, {3e6f, 0.5f, 12.0f}, OIIO::TypeFloat));
    EXPECT_NEAR(middle(sun).r, 3e6f, 2e4f) << "half would clip the sun";
}

TEST_F(Textures, ExplicitColourSpaces) {
    for (const std::string& path :
         {constant("a.png", 2, {0.2f, 0.4f, 0.8f}),
          constant("deep.png", 2, {0.2f, 0.4f, 0.8f}, OIIO::TypeUInt16)}) {
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
    expectMiddle(open(constant("a.png", 2, {0.2f, 0.4f, 0.8f}), "kodachrome"),
                 {0.2f, 0.4f, 0.8f, 1}, 1e-6f, "raw");
    const std::string message = onlyWarning(diagnostics);
    for (const char* part : {"kodachrome", "/Material/texture", "inputs:file", "a.png"})
        EXPECT_TRUE(has(message, part)) << message;
}

TEST_F(Textures, MissingFileIsMagentaWithOneWarningThatNamesAll) {
    int handle = open(temp.file("gone.png"));
    EXPECT_FALSE(textures.valid(handle));
    EXPECT_EQ(middle(handle), magenta);
    EXPECT_EQ(open(temp.file("gone.png")), handle);
    const std::string message = onlyWarning(diagnostics);
    for (const char* part : {"/Material/texture", "inputs:file", "gone.png"})
        EXPECT_TRUE(has(message, part)) << message;
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
        std::vector<float> noise(64 * 64 * 3);
        for (size_t i = 0; i < noise.size(); ++i)
            noise[i] = float((i * 7919) % 1000) / 1000.0f;
        writeImage(temp.file(name), OIIO::ImageSpec(64, 64, 3, OIIO::TypeFloat), noise);
        auto size = std::filesystem::file_size(temp.file(name));
        std::filesystem::resize_file(temp.file(name), size / 2);
        int before = diagnostics.count();
        EXPECT_EQ(middle(open(temp.file(name))), magenta) << name;
        EXPECT_GT(diagnostics.count(), before) << name;
    }
}

TEST_F(Textures, NotFiniteTexelsBecomeBlackWithAWarning) {
    for (auto type : {OIIO::TypeFloat, OIIO::TypeHalf}) {
        const std::string name = type == OIIO::TypeHalf ? "half.exr" : "float.exr";
        expectMiddle(open(constant(name, 2, {NAN, 0.5f, INFINITY}, type)), {0, 0.5f, 0, 1}, 1e-6f,
                     name);
    }
    EXPECT_EQ(diagnostics.count(), 2);
    EXPECT_TRUE(has(diagnostics.all()[0].message, "8 values")) << diagnostics.all()[0].message;
}

TEST_F(Textures, TexelsThatColourSpacesMakeInfiniteBecomeBlackWithAWarning) {
    const glm::vec4 found = middle(
        open(constant("bright.exr", 2, {1e17f, 0.5f, 0.5f}, OIIO::TypeFloat), "srgb_texture"));
    EXPECT_EQ(found.x, 0.0f);
    EXPECT_NEAR(found.y, 0.214f, 1e-3f);
    EXPECT_TRUE(has(onlyWarning(diagnostics), "4 values")) << onlyWarning(diagnostics);
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
    expectSample(handle, {0.0f, 0.5f}, magenta);
    EXPECT_TRUE(has(onlyWarning(diagnostics), "300000000x1x1 is not a texture"))
        << onlyWarning(diagnostics);
}

TEST_F(Textures, NamesOfVeryManyTilesHaveNone) {
    std::string name = temp.file("");
    for (int i = 0; i < 170000; ++i)
        name += "<UDIM>";
    EXPECT_FALSE(textures.valid(open(name)));
}

TEST_F(Textures, ImagesOfLightsAreWithinALimit) {
    const std::string file = constant("grey.png", 600, {0.5f}); // 360 kB, 4.3 MB as floats
    const auto load = [&] {
        return loadImageLinear({file, "auto", "/Rect", "texture"}, diagnostics).valid;
    };
    setLimits({{"textureBytes", 1000000}});
    EXPECT_FALSE(load());
    setLimits({});
    EXPECT_TRUE(has(onlyWarning(diagnostics), "--limit textureBytes")) << onlyWarning(diagnostics);
    EXPECT_TRUE(load());
}

TEST_F(Textures, ImagesOfLightsAreAsTheirFilesSay) {
    const std::string file = constant("half.png", 1, {0.5f, 0.5f, 0.5f});
    const auto load = [&](const char* space) {
        return loadImageLinear({file, space, "/Rect", "texture"}, diagnostics).pixels.at(0).x;
    };
    EXPECT_NEAR(load(""), 0.2159f, 1e-3f); // eight bits of colour are sRGB
    EXPECT_NEAR(load("raw"), 0.502f, 1e-3f);
}

TEST_F(Textures, ChannelsBeyondFourAndTwoColourChannels) {
    const auto named = [](std::vector<std::string> names) {
        return [=](OIIO::ImageSpec& spec) { spec.channelnames = names; };
    };
    const int many = open(constant("many.exr", 2, {0.1f, 0.2f, 0.3f, 0.4f, 0.5f}, OIIO::TypeFloat,
                                   named({"R", "G", "B", "X", "Y"})));
    EXPECT_EQ(textures.channels(many), 3);
    expectMiddle(many, {0.1f, 0.2f, 0.3f, 1}, 1e-6f, "many");
    expectMiddle(open(constant("rg.exr", 2, {0.1f, 0.2f}, OIIO::TypeFloat, named({"R", "G"}))),
                 {0.1f, 0.2f, 0, 1}, 1e-6f, "rg");
}

TEST_F(Textures, StraightAlphaIsNotMultipliedIn) {
    expectMiddle(open(constant("glass.png", 2, {0.8f, 0.6f, 0.4f, 0.0f}), "raw"),
                 {0.8f, 0.6f, 0.4f, 0}, 1e-6f, "glass");
}

TEST_F(Textures, UdimTiles) {
    constant("t.1001.png", 4, {1, 0, 0});
    constant("t.1002.png", 4, {0, 1, 0});
    constant("t.1011.png", 4, {0, 0, 1});
    constant("t.10x1.png", 4, {1, 1, 1});
    const glm::vec4 red(1, 0, 0, 1), green(0, 1, 0, 1), blue(0, 0, 1, 1);
    int handle = open(temp.file("t.<UDIM>.png"));
    ASSERT_TRUE(textures.valid(handle));
    expectSample(handle, {0.5f, 0.5f}, red);
    expectSample(handle, {1.5f, 0.5f}, green);
    expectSample(handle, {0.5f, 1.5f}, blue);
    expectSample(handle, {0.999f, 0.5f}, red); // no bleeding
    expectSample(handle, {2.0f, 0.5f}, green); // the far edge
    expectSample(handle, {1.0f, 2.0f}, blue);  // the far corner
    EXPECT_EQ(diagnostics.count(), 0);
    expectSample(handle, {1.5f, 1.5f}, magenta);
    expectSample(handle, {1.6f, 1.6f}, magenta);
    EXPECT_TRUE(has(onlyMessage(diagnostics), "1012"));
    for (const glm::vec2 uv :
         {glm::vec2(-0.5f, 0.5f), glm::vec2(10.5f, 0.5f), glm::vec2(1e30f, -1e30f)})
        expectSample(handle, uv, magenta);
    EXPECT_EQ(diagnostics.count(), 2);
    EXPECT_FALSE(textures.valid(open(temp.file("none.<UDIM>.png"))));
    constant("m_u1_v2.png", 4, {0, 0, 1});
    expectSample(open(temp.file("m_<UVTILE>.png")), {0.5f, 1.5f}, blue); // as Mudbox names tiles
}

TEST_F(Textures, EqualRequestsShareAHandleAndDifferentOnesThePixels) {
    TextureRequest request = requestOf(constant("a.png", 8, {0.2f, 0.4f, 0.8f}), "sRGB");
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
        handles.push_back(
            open(constant("t" + std::to_string(i) + ".png", 128, {float(i) / 255.0f})));
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
    writeImage(temp.file("edge.png"), OIIO::ImageSpec(4, 1, 1, OIIO::TypeUInt8), {0, 1, 0, 1});
    TextureSystem finest(diagnostics);
    finest.sampleFinestOnly();
    const TextureRequest request = requestOf(temp.file("edge.png"), "raw");
    const glm::vec2 texel(0.375f, 0.5f);
    EXPECT_EQ(finest.sample(finest.open(request), texel, 1.0f).r, 1.0f);
    // Coarser levels of images of eight bits have eight bits.
    EXPECT_NEAR(textures.sample(textures.open(request), texel, 1.0f).r, 0.5f, 1.0f / 255.0f);
}

TEST_F(Textures, LinearImagesForLights) {
    writeConstant(temp.file("sky.exr"), 4, 2, {0.1f, 5.0f, 0.3f}, OIIO::TypeFloat);
    ImageRGB image =
        loadImageLinear({temp.file("sky.exr"), "auto", "/Dome", "texture"}, diagnostics);
    EXPECT_TRUE(image.valid);
    EXPECT_EQ(image.width * 100 + image.height, 402);
    EXPECT_EQ(image.pixels.size(), 8u);
    EXPECT_EQ(image.pixels[7], glm::vec3(0.1f, 5.0f, 0.3f));
    image = loadImageLinear({temp.file("no.exr"), "auto", "/Dome", "texture"}, diagnostics);
    EXPECT_FALSE(image.valid);
    EXPECT_EQ(image.pixels.at(0), glm::vec3(1, 0, 1));
    EXPECT_TRUE(has(onlyWarning(diagnostics), "/Dome"));
}

// A profile that falls with the cosine: its mean over the hemisphere is half of its peak, so the
// factor is 2 cos. The table is linear between every 5 degrees.
TEST_F(Textures, ReadsIesProfiles) {
    const std::string file = temp.file("lamp.ies");
    std::string angles, candela;
    for (int i = 0; i <= 90; i += 5) {
        angles += std::to_string(i) + " ";
        candela += std::to_string(700.0 * std::cos(i * 0.017453292519943295)) + " ";
    }
    writeFile(file, "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 19 1 1 2 0 0 0\n1 1 100\n" + angles +
                        "\n0\n" + candela + "\n");
    TextureRequest request = requestOf(file);
    const auto profile = textures.openProfile(request);
    ASSERT_TRUE(profile);
    EXPECT_EQ(profile, textures.openProfile(request));
    for (float theta : {0.0f, 0.4f, 1.0f, 1.5f})
        EXPECT_NEAR(profile->factor(theta, 2.0f), 2.0f * std::cos(theta), 6e-3f) << theta;
    EXPECT_EQ(profile->factor(1.7f, 0.0f), 0.0f);

    // The twelfth number was a factor once. In files of 2019 it says how they were made.
    for (const auto& [standard, peak] :
         {std::pair{"IESNA91", 770.0f}, {"IES:LM-63-2019", 700.0f}}) {
        IesProfile own;
        std::string error;
        ASSERT_TRUE(own.parse(standard + ("\nTILT=NONE\n1 1000 1 19 1 1 2 0 0 0\n1 1.1 100\n" +
                                          angles + "\n0\n" + candela),
                              error))
            << error;
        EXPECT_FLOAT_EQ(own.peak(), peak);
    }

    request.file = temp.file("missing.ies");
    EXPECT_FALSE(textures.openProfile(request));
    EXPECT_FALSE(textures.openProfile(request)); // says so once
    EXPECT_NE(onlyWarning(diagnostics).find("it emits the same everywhere"), std::string::npos);
}

} // namespace patina

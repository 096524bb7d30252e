// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/imageTexture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace patina {

namespace {

using Wrap = TextureWrap;

/// A float grey texture from values, top row first.
ImageTexture greyTexture(int width, int height, std::vector<float> values) {
    ImageTexture t(width, height, TexelLayout::Grey, TexelType::Float);
    std::copy(values.begin(), values.end(), static_cast<float*>(t.levelData(0)));
    t.buildPyramid();
    return t;
}

float at(const ImageTexture& t, float u, float v, Wrap s = Wrap::Clamp, Wrap w = Wrap::Clamp,
         float footprint = 0) {
    return t.sample({u, v}, footprint, s, w).r;
}

/// Decodes eight bits.
std::array<float, 256> squares() {
    std::array<float, 256> square;
    for (size_t i = 0; i < 256; ++i)
        square[i] = float(i * i) / (255.0f * 255.0f);
    return square;
}

} // namespace

TEST(ImageTexture, TexelCentresGiveTexelsWithTheFirstRowOnTop) {
    ImageTexture t = greyTexture(2, 2, {1, 2, 3, 4});
    for (const auto& [u, v, expected] : {std::tuple(0.25f, 0.75f, 1.0f),
                                         {0.75f, 0.75f, 2.0f},
                                         {0.25f, 0.25f, 3.0f},
                                         {0.75f, 0.25f, 4.0f},
                                         {0.5f, 0.5f, 2.5f},
                                         {0.375f, 0.75f, 1.25f}})
        EXPECT_FLOAT_EQ(at(t, u, v), expected) << u << " " << v;
}

TEST(ImageTexture, WrapModes) {
    ImageTexture t = greyTexture(4, 1, {1, 2, 3, 4});
    // texel centres beyond the right and the left side
    struct {
        Wrap wrap;
        float right[3], left[3];
    } cases[] = {{Wrap::Repeat, {1, 2, 3}, {4, 3, 2}},
                 {Wrap::Mirror, {4, 3, 2}, {1, 2, 3}},
                 {Wrap::Clamp, {4, 4, 4}, {1, 1, 1}},
                 {Wrap::Black, {0, 0, 0}, {0, 0, 0}}};
    for (auto& c : cases)
        for (int i = 0; i < 3; ++i) {
            float u = 1.125f + 0.25f * float(i);
            EXPECT_FLOAT_EQ(at(t, u, 0.5f, c.wrap, Wrap::Clamp), c.right[i]) << int(c.wrap) << i;
            EXPECT_FLOAT_EQ(at(t, 1 - u, 0.5f, c.wrap, Wrap::Clamp), c.left[i]) << int(c.wrap) << i;
            EXPECT_FLOAT_EQ(t.sampleNearest({u, 0.5f}, c.wrap, Wrap::Clamp).r, c.right[i]);
            EXPECT_FLOAT_EQ(t.sampleNearest({1 - u, 0.5f}, c.wrap, Wrap::Clamp).r, c.left[i]);
        }
    // at the seam
    EXPECT_FLOAT_EQ(at(t, 1, 0.5f, Wrap::Repeat, Wrap::Clamp), 2.5f);
    EXPECT_FLOAT_EQ(at(t, 0, 0.5f, Wrap::Repeat, Wrap::Clamp), 2.5f);
    EXPECT_FLOAT_EQ(at(t, 1, 0.5f, Wrap::Mirror, Wrap::Clamp), 4);
    EXPECT_FLOAT_EQ(at(t, 1, 0.5f, Wrap::Black, Wrap::Clamp), 2) << "half of the border is black";
    EXPECT_EQ(t.sample({2, 0.5f}, 0, Wrap::Black, Wrap::Clamp), glm::vec4(0)) << "alpha too";
}

TEST(ImageTexture, WrapsTheSameFarAway) {
    ImageTexture t = greyTexture(4, 4, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});
    for (Wrap wrap : {Wrap::Repeat, Wrap::Mirror})
        for (float u : {0.1f, 0.3f, 0.9f}) {
            float near = at(t, u, u, wrap, wrap);
            EXPECT_NEAR(at(t, u + 64, u - 128, wrap, wrap), near, 1e-3f);
        }
}

TEST(ImageTexture, PyramidHalvesAndAverages) {
    ImageTexture t = greyTexture(4, 2, {0, 4, 8, 12, 4, 8, 12, 16});
    ASSERT_EQ(t.levels().size(), 3u);
    EXPECT_EQ(t.levels()[1].width, 2);
    EXPECT_EQ(t.levels()[1].height, 1);
    EXPECT_FLOAT_EQ(t.texel(1, 0, 0).r, 4);
    EXPECT_FLOAT_EQ(t.texel(1, 1, 0).r, 12);
    EXPECT_FLOAT_EQ(t.texel(2, 0, 0).r, 8);
}

TEST(ImageTexture, OddSidesAreWeightedByArea) {
    ImageTexture three = greyTexture(3, 1, {3, 6, 12});
    EXPECT_FLOAT_EQ(three.texel(1, 0, 0).r, 7);
    ImageTexture five = greyTexture(5, 1, {10, 20, 30, 40, 50});
    // two and a half texels each
    EXPECT_FLOAT_EQ(five.texel(1, 0, 0).r, (10 + 20 + 15) / 2.5f);
    EXPECT_FLOAT_EQ(five.texel(1, 1, 0).r, (15 + 40 + 50) / 2.5f);
}

TEST(ImageTexture, EveryLevelKeepsTheMean) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> u;
    for (int width : {1, 2, 3, 7, 37, 64}) {
        for (int height : {1, 5, 19, 32}) {
            std::vector<float> values(size_t(width * height));
            double mean = 0;
            for (float& v : values)
                mean += v = u(random);
            mean /= double(values.size());
            ImageTexture t = greyTexture(width, height, values);
            EXPECT_NEAR(t.texel(int(t.levels().size()) - 1, 0, 0).r, mean, 1e-5)
                << width << "x" << height;
        }
    }
}

TEST(ImageTexture, TrilinearBlendsLevelsByTheLogarithmOfTheFootprint) {
    ImageTexture t = greyTexture(4, 4, {0, 16, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    glm::vec2 uv(0.25f, 0.75f); // a texel centre of level 1, a corner in level 0
    float levels[3] = {4, 4, 1};
    for (const auto& [footprint, expected] : {std::pair(0.0f, levels[0]),
                                              {0.25f, levels[0]},
                                              {0.5f, levels[1]},
                                              {1.0f, levels[2]},
                                              {1e30f, levels[2]}})
        EXPECT_FLOAT_EQ(at(t, uv.x, uv.y, Wrap::Clamp, Wrap::Clamp, footprint), expected)
            << footprint;
    EXPECT_NEAR(at(t, uv.x, uv.y, Wrap::Clamp, Wrap::Clamp, 0.5f * std::sqrt(2.0f)),
                0.5f * (levels[1] + levels[2]), 1e-5f);
    // off centre: level 0 at the texel centre is 16, level 1 is 0.75^2 * 4 there
    EXPECT_NEAR(at(t, 0.375f, 0.875f, Wrap::Clamp, Wrap::Clamp, 0.25f * std::pow(2.0f, 0.25f)),
                0.75f * 16 + 0.25f * 3.0f, 1e-4f);
}

TEST(ImageTexture, EightBitColourIsDecodedAndAlphaIsNot) {
    ImageTexture t(2, 1, TexelLayout::Rgba, TexelType::U8);
    const uint8_t texels[] = {0, 100, 255, 128, 0, 200, 255, 64};
    std::copy(std::begin(texels), std::end(texels), static_cast<uint8_t*>(t.levelData(0)));
    t.setDecodeTable(squares());
    t.buildPyramid();
    glm::vec4 c = t.texel(0, 0, 0);
    EXPECT_FLOAT_EQ(c.g, 100.0f * 100.0f / (255.0f * 255.0f));
    EXPECT_FLOAT_EQ(c.b, 1.0f);
    EXPECT_FLOAT_EQ(c.a, 128.0f / 255.0f);
    // averaged in linear light: sqrt((100^2+200^2)/2) = 158.1
    glm::vec4 mean = t.texel(1, 0, 0);
    EXPECT_FLOAT_EQ(mean.g, 158.0f * 158.0f / (255.0f * 255.0f));
    EXPECT_FLOAT_EQ(mean.a, 96.0f / 255.0f);
    EXPECT_FLOAT_EQ(mean.r, 0.0f);
    EXPECT_FLOAT_EQ(mean.b, 1.0f);
}

TEST(ImageTexture, LevelsOfConstantEightBitImagesAreExactlyTheConstant) {
    std::array<float, 256> srgb;
    for (size_t i = 0; i < 256; ++i) {
        double v = double(i) / 255;
        srgb[i] = float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    for (int code = 0; code < 256; ++code) {
        ImageTexture t(4, 4, TexelLayout::Grey, TexelType::U8);
        std::fill_n(static_cast<uint8_t*>(t.levelData(0)), 16, uint8_t(code));
        t.setDecodeTable(srgb);
        t.buildPyramid();
        for (int level = 0; level < 3; ++level)
            EXPECT_EQ(t.texel(level, 0, 0).r, srgb[size_t(code)]) << code << " level " << level;
    }
}

TEST(ImageTexture, ChannelLayouts) {
    struct {
        TexelLayout layout;
        glm::vec4 expected;
    } cases[] = {{TexelLayout::Grey, {0.1f, 0.1f, 0.1f, 1}},
                 {TexelLayout::GreyAlpha, {0.1f, 0.1f, 0.1f, 0.2f}},
                 {TexelLayout::RedGreen, {0.1f, 0.2f, 0, 1}},
                 {TexelLayout::Rgb, {0.1f, 0.2f, 0.3f, 1}},
                 {TexelLayout::Rgba, {0.1f, 0.2f, 0.3f, 0.4f}}};
    for (auto& c : cases) {
        ImageTexture t(1, 1, c.layout, TexelType::Float);
        for (int i = 0; i < t.channels(); ++i)
            static_cast<float*>(t.levelData(0))[i] = 0.1f * float(i + 1);
        EXPECT_EQ(t.sample({0.5f, 0.5f}, 0, Wrap::Repeat, Wrap::Repeat), c.expected);
    }
}

// A colour image with three equal channels is kept as grey, which must change no bit of a render.
TEST(ImageTexture, GreyOfEqualChannelsIsSampledToTheSameBits) {
    constexpr int width = 37, height = 19;
    std::mt19937 random(7);
    for (const TexelType type : {TexelType::U8, TexelType::U16, TexelType::Half, TexelType::Float})
        for (const TexelLayout layout : {TexelLayout::Rgb, TexelLayout::Rgba}) {
            ImageTexture colored(width, height, layout, type);
            const size_t n = size_t(colored.channels());
            for (size_t i = 0; i < size_t(width * height); ++i) {
                const uint32_t value = random(), alpha = random();
                for (size_t c = 0; c < n; ++c) {
                    const uint32_t v = c == 3 ? alpha : value;
                    void* data = colored.levelData(0);
                    if (type == TexelType::U8)
                        static_cast<uint8_t*>(data)[i * n + c] = uint8_t(v);
                    else if (type == TexelType::Float)
                        static_cast<float*>(data)[i * n + c] = float(v) * 1e-9f;
                    else // of halves those below 1
                        static_cast<uint16_t*>(data)[i * n + c] = uint16_t(v % 0x3c00);
                }
            }
            if (type == TexelType::U8) colored.setDecodeTable(squares());
            const std::shared_ptr<ImageTexture> grey = colored.asGrey();
            ASSERT_TRUE(grey);
            EXPECT_EQ(grey->channels(), layout == TexelLayout::Rgb ? 1 : 2);
            colored.buildPyramid();
            grey->buildPyramid();
            std::uniform_real_distribution<float> any(-1.0f, 2.0f), lambda(-8.0f, 0.0f);
            for (int i = 0; i < 2000; ++i) {
                const glm::vec2 uv(any(random), any(random));
                const float footprint = std::exp2(lambda(random));
                const Wrap wrap = Wrap(random() % 4);
                ASSERT_EQ(colored.sample(uv, footprint, wrap, wrap),
                          grey->sample(uv, footprint, wrap, wrap));
                ASSERT_EQ(colored.sampleNearest(uv, wrap, wrap),
                          grey->sampleNearest(uv, wrap, wrap));
            }
        }
}

TEST(ImageTexture, OneTexelOfColourKeepsAllChannels) {
    for (size_t channel = 0; channel < 3; ++channel) {
        ImageTexture t(5, 3, TexelLayout::Rgb, TexelType::Half);
        std::fill_n(static_cast<uint16_t*>(t.levelData(0)), 45, uint16_t(0x3800));
        EXPECT_TRUE(t.asGrey());
        static_cast<uint16_t*>(t.levelData(0))[42 + channel] = 0x3801;
        EXPECT_FALSE(t.asGrey()) << channel;
    }
    ImageTexture grey(5, 3, TexelLayout::Grey, TexelType::U8);
    EXPECT_FALSE(grey.asGrey()) << "there is nothing to gain";
}

TEST(ImageTexture, CoordinatesThatAreNoNumbersDoNoHarm) {
    ImageTexture t = greyTexture(3, 3, {1, 1, 1, 1, 1, 1, 1, 1, 1});
    const float bad[] = {NAN, INFINITY, -INFINITY, 3e38f, -3e38f, 1e10f};
    for (float u : bad)
        for (float v : bad)
            for (Wrap wrap : {Wrap::Repeat, Wrap::Mirror, Wrap::Clamp, Wrap::Black})
                for (float footprint : {0.0f, bad[0], bad[1], bad[2]}) {
                    float r = at(t, u, v, wrap, wrap, footprint);
                    EXPECT_TRUE(std::isfinite(r));
                    r = t.sampleNearest({u, v}, wrap, wrap).r;
                    EXPECT_TRUE(r == 0 || r == 1);
                }
}

} // namespace patina

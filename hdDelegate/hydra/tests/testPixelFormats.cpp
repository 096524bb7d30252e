// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/aovs.h"
#include "hdDelegate/hydra/clearValue.h"
#include "hdDelegate/hydra/pixelFormats.h"

#include <gtest/gtest.h>
#include <pxr/base/gf/half.h>
#include <pxr/base/gf/vec3d.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/imaging/hd/tokens.h>

#include <cmath>
#include <cstring>
#include <limits>

using namespace patina;

namespace {

float bits(int32_t value) {
    float result;
    std::memcpy(&result, &value, sizeof result);
    return result;
}

} // namespace

TEST(PixelFormats, EightBitsAreClampedAndRounded) {
    const float values[4] = {-1.0f, 0.5f, 2.0f, NAN};
    uint8_t out[4];
    writePixels(values, 1, false, HdFormatUNorm8Vec4, out);
    EXPECT_EQ(out[0], 0);
    EXPECT_EQ(out[1], 128);
    EXPECT_EQ(out[2], 255);
    EXPECT_EQ(out[3], 0);
    int8_t signedOut[4];
    writePixels(values, 1, false, HdFormatSNorm8Vec4, signedOut);
    EXPECT_EQ(signedOut[0], -127);
    EXPECT_EQ(signedOut[2], 127);
}

TEST(PixelFormats, HalfsNeverOverflow) {
    const float values[4] = {1e9f, -1e9f, 0.25f, NAN};
    GfHalf out[4];
    writePixels(values, 1, false, HdFormatFloat16Vec4, out);
    EXPECT_EQ(float(out[0]), 65504.0f);
    EXPECT_EQ(float(out[1]), -65504.0f);
    EXPECT_EQ(float(out[2]), 0.25f);
    EXPECT_EQ(float(out[3]), 0.0f);
}

TEST(PixelFormats, IdsKeepTheirNumberInEveryFormat) {
    for (const int32_t id : {-1, 0, 77, std::numeric_limits<int32_t>::max()}) {
        const float values[4] = {bits(id), 0, 0, 0};
        int32_t whole = 5;
        writePixels(values, 1, true, HdFormatInt32, &whole);
        EXPECT_EQ(whole, id);
    }
    const float values[4] = {bits(300), 0, 0, 0};
    float real = 0;
    writePixels(values, 1, true, HdFormatFloat32, &real);
    EXPECT_EQ(real, 300.0f);
}

TEST(PixelFormats, PixelsFollowEachOtherWithoutWhatTheFormatLacks) {
    const float values[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    float reals[4] = {0, 0, 0, 0};
    writePixels(values, 2, false, HdFormatFloat32Vec2, reals);
    EXPECT_EQ(reals[1], 2.0f);
    EXPECT_EQ(reals[2], 5.0f);
    EXPECT_EQ(reals[3], 6.0f);
    const float ids[8] = {bits(7), 9, 9, 9, bits(-1), 9, 9, 9};
    int32_t whole[2] = {0, 0};
    writePixels(ids, 2, true, HdFormatInt32, whole);
    EXPECT_EQ(whole[0], 7);
    EXPECT_EQ(whole[1], -1);
    writePixels(ids, 2, true, HdFormatFloat32Vec2, reals);
    EXPECT_EQ(reals[0], 7.0f);
    EXPECT_EQ(reals[1], 0.0f);
    EXPECT_EQ(reals[2], -1.0f);
}

TEST(PixelFormats, NothingIsWrittenBeyondThePixel) {
    for (int f = HdFormatUNorm8; f < HdFormatCount; ++f) {
        const HdFormat format = HdFormat(f);
        if (!isWritableFormat(format)) continue;
        const size_t size = HdDataSizeOfFormat(format);
        uint8_t out[64];
        std::memset(out, 0xAB, sizeof out);
        const float values[4] = {1, 1, 1, 1};
        writePixels(values, 1, false, format, out);
        for (size_t i = size; i < sizeof out; ++i)
            ASSERT_EQ(out[i], 0xAB) << "format " << f;
    }
    EXPECT_FALSE(isWritableFormat(HdFormatInvalid));
    EXPECT_FALSE(isWritableFormat(HdFormatFloat32UInt8));
}

TEST(Aovs, HydraAndFilmMeanDifferentDepths) {
    EXPECT_EQ(filmAovOf(HdAovTokens->depth), "deviceDepth");
    EXPECT_EQ(filmAovOf(HdAovTokens->cameraDepth), "depth");
    EXPECT_EQ(filmAovOf(HdAovTokens->color), "color");
    EXPECT_EQ(filmAovOf(TfToken("primvars:st")), "primvars:st");
    EXPECT_EQ(filmAovOf(TfToken("lpe:C.*")), "color");
    EXPECT_EQ(filmAovOf(TfToken("lpe:C<RD>L")), "lpe:C<RD>L");
    EXPECT_EQ(filmAovOf(TfToken("motionFore")), "motionForward") << "as RenderMan has it";
    EXPECT_EQ(filmAovOf(TfToken("__Pref")), "Pref");
}

TEST(Aovs, LayersOfCryptomatteAreBuffers) {
    const HdPatinaShownAov second = shownAovOf(TfToken("crypto_material01"));
    EXPECT_EQ(second.film, "cryptoMaterial");
    EXPECT_EQ(second.layer, 1);
    EXPECT_EQ(aovDescriptor(TfToken("crypto_object00")).format, HdFormatFloat32Vec4);
    EXPECT_EQ(shownAovOf(TfToken("crypto_object08")).film, "") << "of more ids than are kept";
    EXPECT_EQ(shownAovOf(TfToken("normal")).layer, -1);
    EXPECT_EQ(shownAovOf(TfToken("primvars:t00")).film, "primvars:t00");
}

TEST(Aovs, DescriptorsFitTheFilm) {
    EXPECT_EQ(aovDescriptor(HdAovTokens->depth).format, HdFormatFloat32);
    EXPECT_EQ(aovDescriptor(HdAovTokens->primId).format, HdFormatInt32);
    EXPECT_EQ(aovDescriptor(HdAovTokens->primId).clearValue, VtValue(-1));
    EXPECT_EQ(aovDescriptor(HdAovTokens->normal).format, HdFormatFloat32Vec3);
    EXPECT_EQ(aovDescriptor(TfToken("primvars:st")).format, HdFormatFloat32Vec2);
    EXPECT_EQ(aovDescriptor(TfToken("key=lpe:C.*<L.'key'>")).format, HdFormatFloat32Vec3);
    EXPECT_EQ(aovDescriptor(TfToken("Ng")).format, HdFormatFloat32Vec3);
    EXPECT_EQ(aovDescriptor(TfToken("uv")).format, HdFormatFloat32Vec2);
    EXPECT_EQ(aovDescriptor(TfToken("motionBackward")).format, HdFormatFloat32Vec2);
    EXPECT_EQ(aovDescriptor(TfToken("nonsense")).format, HdFormatInvalid);
}

TEST(ClearValue, ReadsWhatHostsSend) {
    EXPECT_TRUE(clearValueOf(VtValue()).empty);
    EXPECT_TRUE(clearValueOf(VtValue(std::string("x"))).empty);
    EXPECT_EQ(clearValueOf(VtValue(1.0)).values[0], 1.0f);
    EXPECT_EQ(clearValueOf(VtValue(GfVec4f(1, 2, 3, 4))).values[3], 4.0f);
    EXPECT_EQ(clearValueOf(VtValue(GfVec3d(1, 2, 3))).values[2], 3.0f);
    const ClearValue id = clearValueOf(VtValue(-1));
    EXPECT_TRUE(id.isInteger);
    EXPECT_EQ(std::memcmp(&id.values[0], "\xff\xff\xff\xff", 4), 0);
}

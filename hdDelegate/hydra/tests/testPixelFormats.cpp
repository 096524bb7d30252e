// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/aovs.h"
#include "hdDelegate/hydra/clearValue.h"
#include "hdDelegate/hydra/pixelFormats.h"
#include "base/tests/testTools.h"

#include <pxr/base/gf/half.h>
#include <pxr/base/gf/vec3d.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/imaging/hd/tokens.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>

using namespace patina;

namespace {

/// So many numbers as a format writes them, of pixels of four.
template <class T> std::vector<T> written(const std::vector<float>& values, HdFormat format,
                                          size_t count, bool ids = false) {
    std::vector<T> out(count);
    writePixels(values.data(), values.size() / 4, ids, format, out.data());
    return out;
}

} // namespace

TEST(PixelFormats, EightBitsAreClampedAndRounded) {
    const std::vector<float> values = {-1.0f, 0.5f, 2.0f, NAN};
    EXPECT_EQ(written<uint8_t>(values, HdFormatUNorm8Vec4, 4),
              (std::vector<uint8_t>{0, 128, 255, 0}));
    const auto signedOut = written<int8_t>(values, HdFormatSNorm8Vec4, 4);
    EXPECT_EQ(signedOut[0], -127);
    EXPECT_EQ(signedOut[2], 127);
}

TEST(PixelFormats, HalfsNeverOverflow) {
    const auto out = written<GfHalf>({1e9f, -1e9f, 0.25f, NAN}, HdFormatFloat16Vec4, 4);
    EXPECT_EQ(std::vector<float>(out.begin(), out.end()),
              (std::vector<float>{65504.0f, -65504.0f, 0.25f, 0.0f}));
}

TEST(PixelFormats, IdsKeepTheirNumberInEveryFormat) {
    for (const int32_t id : {-1, 0, 77, std::numeric_limits<int32_t>::max()})
        EXPECT_EQ(written<int32_t>({floatOfBits(id), 0, 0, 0}, HdFormatInt32, 1, true)[0], id);
    EXPECT_EQ(written<float>({floatOfBits(300), 0, 0, 0}, HdFormatFloat32, 1, true)[0], 300.0f);
}

TEST(PixelFormats, PixelsFollowEachOtherWithoutWhatTheFormatLacks) {
    EXPECT_EQ(written<float>({1, 2, 3, 4, 5, 6, 7, 8}, HdFormatFloat32Vec2, 4),
              (std::vector<float>{1, 2, 5, 6}));
    const std::vector<float> ids = {floatOfBits(7), 9, 9, 9, floatOfBits(-1), 9, 9, 9};
    EXPECT_EQ(written<int32_t>(ids, HdFormatInt32, 2, true), (std::vector<int32_t>{7, -1}));
    EXPECT_EQ(written<float>(ids, HdFormatFloat32Vec2, 4, true), (std::vector<float>{7, 0, -1, 0}));
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
    const std::map<std::string, std::string> names = {
        {"depth", "deviceDepth"},
        {"cameraDepth", "depth"},
        {"color", "color"},
        {"primvars:st", "primvars:st"},
        {"lpe:C.*", "color"},
        {"lpe:C<RD>L", "lpe:C<RD>L"},
        {"motionFore", "motionForward"}, // as RenderMan has it
        {"__Pref", "Pref"}};
    for (const auto& [hydras, films] : names)
        EXPECT_EQ(filmAovOf(TfToken(hydras)), films);
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
    const std::map<std::string, HdFormat> formats = {{"depth", HdFormatFloat32},
                                                     {"primId", HdFormatInt32},
                                                     {"normal", HdFormatFloat32Vec3},
                                                     {"primvars:st", HdFormatFloat32Vec2},
                                                     {"key=lpe:C.*<L.'key'>", HdFormatFloat32Vec3},
                                                     {"Ng", HdFormatFloat32Vec3},
                                                     {"uv", HdFormatFloat32Vec2},
                                                     {"motionBackward", HdFormatFloat32Vec2},
                                                     {"nonsense", HdFormatInvalid}};
    for (const auto& [name, format] : formats)
        EXPECT_EQ(aovDescriptor(TfToken(name)).format, format) << name;
    EXPECT_EQ(aovDescriptor(HdAovTokens->primId).clearValue, VtValue(-1));
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

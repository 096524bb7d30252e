// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderBuffer.h"
#include "hdDelegate/hydra/tests/warnings.h"

#include <gtest/gtest.h>
#include <pxr/base/gf/vec3i.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/base/tf/errorMark.h>

#include <algorithm>
#include <cstring>

using namespace patina;

namespace {

const auto textures = std::make_shared<HdPatinaHostTextures>();

/// An image of floats.
HdPatinaPixels imageOf(const std::vector<float>& values) {
    HdPatinaPixels image;
    image.bytes.resize(values.size() * sizeof(float));
    std::memcpy(image.bytes.data(), values.data(), image.bytes.size());
    return image;
}

/// Pixels of one float.
bool allocate(HdPatinaRenderBuffer& buffer, int width, int height) {
    return buffer.Allocate(GfVec3i(width, height, 1), HdFormatFloat32, false);
}
float valueAt(HdPatinaRenderBuffer& buffer, size_t i) {
    const float found = static_cast<float*>(buffer.Map())[i];
    buffer.Unmap();
    return found;
}

/// A device whose pixels are all one number.
struct OneNumber : DeviceImage {
    explicit OneNumber(float number, size_t size) : values(size, number) {}
    bool copyTo(uint64_t) override { return true; }
    bool read(void* bytes) override {
        ++reads;
        std::memcpy(bytes, values.data(), values.size() * sizeof(float));
        return true;
    }
    std::vector<float> values;
    int reads = 0;
};

} // namespace

TEST(RenderBuffer, RefusesWhatItCannotHold) {
    HdPatinaRenderBuffer buffer(SdfPath("/buffer"), textures);
    EXPECT_FALSE(buffer.Allocate(GfVec3i(4, 4, 2), HdFormatFloat32, false));
    EXPECT_FALSE(buffer.Allocate(GfVec3i(-1, 4, 1), HdFormatFloat32, false));
    EXPECT_FALSE(buffer.Allocate(GfVec3i(4, 4, 1), HdFormatInvalid, false));
    EXPECT_EQ(buffer.GetWidth(), 0u);
    EXPECT_TRUE(buffer.Allocate(GfVec3i(0, 0, 1), HdFormatFloat32, false));
    EXPECT_EQ(buffer.Map(), nullptr);
    buffer.Unmap();
}

TEST(RenderBuffer, CountsItsMappers) {
    HdPatinaRenderBuffer buffer(SdfPath("/buffer"), textures);
    ASSERT_TRUE(allocate(buffer, 3, 2));
    buffer.Map();
    buffer.Map();
    buffer.Unmap();
    EXPECT_TRUE(buffer.IsMapped());
    HdPatinaPixels image = imageOf(std::vector<float>(6, 1.0f));
    EXPECT_FALSE(buffer.take(image)) << "a host is reading";
    buffer.Unmap();
    EXPECT_FALSE(buffer.IsMapped());
    EXPECT_TRUE(buffer.take(image));
    EXPECT_EQ(image.bytes, imageOf(std::vector<float>(6, 0.0f)).bytes) << "the memory of before";
    EXPECT_EQ(valueAt(buffer, 5), 1.0f);
    buffer.Unmap(); // one too many
    EXPECT_FALSE(buffer.IsMapped());
}

TEST(RenderBuffer, LeavesImagesOfAnotherSizeAlone) {
    HdPatinaRenderBuffer buffer(SdfPath("/buffer"), textures);
    ASSERT_TRUE(allocate(buffer, 2, 1));
    HdPatinaPixels larger = imageOf({1.0f, 2.0f, 3.0f}), none;
    EXPECT_TRUE(buffer.take(larger));
    EXPECT_TRUE(buffer.take(none));
    EXPECT_EQ(larger.bytes, imageOf({1.0f, 2.0f, 3.0f}).bytes);
    EXPECT_EQ(valueAt(buffer, 1), 0.0f);
}

TEST(RenderBuffer, ReadsWhatIsOnADeviceWhenAHostMapsIt) {
    HdPatinaRenderBuffer buffer(SdfPath("/buffer"), textures);
    ASSERT_TRUE(allocate(buffer, 2, 1));
    const auto first = std::make_shared<OneNumber>(1.0f, 2);
    HdPatinaPixels image;
    image.device = first;
    EXPECT_TRUE(buffer.take(image));
    buffer.Resolve();
    EXPECT_TRUE(buffer.GetResource(false).IsEmpty()) << "the host has no Hgi";
    EXPECT_EQ(first->reads, 0);
    EXPECT_EQ(valueAt(buffer, 1), 1.0f);
    EXPECT_EQ(valueAt(buffer, 1), 1.0f);
    EXPECT_EQ(first->reads, 1);
    HdPatinaPixels other = imageOf({2.0f, 3.0f});
    EXPECT_TRUE(buffer.take(other));
    EXPECT_EQ(valueAt(buffer, 1), 3.0f);
    HdPatinaPixels again;
    again.device = std::make_shared<OneNumber>(4.0f, 2);
    EXPECT_TRUE(buffer.take(again));
    ASSERT_TRUE(allocate(buffer, 2, 1));
    EXPECT_EQ(valueAt(buffer, 1), 0.0f) << "of another allocation";
}

TEST(RenderBuffer, EveryAllocationHasANumberOfItsOwn) {
    HdPatinaRenderBuffer a(SdfPath("/a"), textures), b(SdfPath("/b"), textures);
    allocate(a, 2, 2);
    const unsigned first = a.allocation();
    allocate(a, 2, 2);
    allocate(b, 2, 2);
    EXPECT_NE(a.allocation(), first);
    EXPECT_NE(a.allocation(), b.allocation());
}

TEST(RenderBuffer, KeepsPixelsThatAreMappedWhileItIsAllocatedAnew) {
    const Warnings warnings;
    const size_t size = 64 * 64;
    HdPatinaRenderBuffer buffer(SdfPath("/buffer"), textures);
    ASSERT_TRUE(allocate(buffer, 64, 64));
    HdPatinaPixels ones = imageOf(std::vector<float>(size, 1.0f));
    ASSERT_TRUE(buffer.take(ones));
    const auto* old = static_cast<const float*>(buffer.Map());
    ASSERT_TRUE(allocate(buffer, 128, 128));
    ASSERT_TRUE(allocate(buffer, 4, 4));
    EXPECT_EQ(std::count(old, old + size, 1.0f), std::ptrdiff_t(size)) << "a host is reading";
    EXPECT_EQ(warnings.of("is freed while it is mapped"), 1);
    EXPECT_FALSE(buffer.IsMapped()) << "of the new pixels there is no map";

    const auto* now = static_cast<const float*>(buffer.Map());
    ASSERT_NE(now, nullptr);
    buffer.Unmap(); // of the old pixels
    EXPECT_TRUE(buffer.IsMapped());
    HdPatinaPixels small = imageOf(std::vector<float>(16, 1.0f));
    EXPECT_FALSE(buffer.take(small)) << "the other map goes on";
    EXPECT_EQ(now[0], 0.0f);
    buffer.Unmap();
    EXPECT_TRUE(buffer.take(small));
    EXPECT_FALSE(buffer.IsMapped());
}

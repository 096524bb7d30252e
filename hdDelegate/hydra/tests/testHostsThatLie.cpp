// SPDX-License-Identifier: Apache-2.0
// Hosts that break promises: buffers that vanish or change while a render runs, windows beside
// them, parts that are taken down in the wrong order.

#include "hdDelegate/hydra/tests/lyingHost.h"
#include "hdDelegate/hydra/tests/warnings.h"
#include "hdDelegate/hydra/values.h"
#include "hdDelegate/scene/tests/prims.h"

#include <pxr/base/tf/errorMark.h>

#include <atomic>
#include <limits>

using namespace patina;

TEST_F(LyingHost, FreesAndChangesBuffersWhileTheyAreDrawn) {
    HdRenderBuffer* color = bindColor();
    ASSERT_TRUE(waitForSky(color));
    const std::vector<std::tuple<int, int, HdFormat, bool>> changes = {
        {16, 12, HdFormatFloat32Vec4, true}, {33, 5, HdFormatFloat32Vec4, false},
        {1, 1, HdFormatFloat32Vec3, true},   {16, 12, HdFormatFloat32, false},
        {5, 33, HdFormatFloat32Vec2, false}, {16, 12, HdFormatFloat32Vec4, false}};
    for (const auto& [width, height, format, multiSampled] : changes) {
        color->Allocate(GfVec3i(width, height, 1), format, multiSampled);
        EXPECT_FALSE(color->IsConverged());
        execute(); // with the framing of before
        frame(width, height);
        color->Allocate(GfVec3i(0, 0, 1), format, multiSampled); // and gone, and back at once
        color->Allocate(GfVec3i(width, height, 1), format, multiSampled);
        EXPECT_TRUE(waitForSky(color)) << width << " x " << height << ", format " << format;
    }
    color->Finalize(&param()); // frees the pixels
    execute();
    EXPECT_EQ(color->GetWidth(), 0u);
    EXPECT_EQ(color->Map(), nullptr);
    color->Unmap();
}

TEST_F(LyingHost, DestroysBuffersThatBindingsStillName) {
    HdRenderBuffer *color = add(), *depth = add(16, 12, HdFormatFloat32);
    bind({binding("depth", depth), binding("color", color)});
    ASSERT_TRUE(waitForSky(color));
    drop(depth);
    EXPECT_TRUE(waitForSky(color));
    drop(color);
    execute();
    execute();
    HdRenderBuffer* other = add(); // perhaps where the first was
    bind({binding("depth", depth), binding("color", other)});
    EXPECT_TRUE(waitForSky(other));
}

TEST_F(LyingHost, BindsBuffersThatAreNoBuffers) {
    HdRenderBuffer *color = add(), *never = add(-1), *empty = add(0, 0);
    HdRenderPassAovBinding unknown = binding("normal", nullptr);
    unknown.renderBufferId = SdfPath("/thereIsNone");
    bind({binding("depth", nullptr), unknown, binding("", add(16, 12)), binding("color", color),
          binding("primvars:", add()), binding("cameraDepth", never), binding("Neye", empty)});
    ASSERT_TRUE(waitForSky(color));
    bind({binding("color", never)});
    execute();
    EXPECT_EQ(never->GetWidth(), 0u);
    bind({});
    execute();
    bind({binding("color", color)});
    EXPECT_TRUE(waitForSky(color));
}

TEST_F(LyingHost, BindsOneBufferTwice) {
    open(2);
    HdRenderBuffer *color = add(), *other = add();
    bind({binding("color", color), binding("color", color), binding("color", other),
          binding("noSuchOutput", other)});
    ASSERT_TRUE(converges());
    EXPECT_TRUE(showsSky(color));
    EXPECT_TRUE(showsSky(other)) << "an output of no name writes nothing";
    EXPECT_TRUE(color->IsConverged() && other->IsConverged());
    bind({binding("depth", color), binding("color", color)});
    ASSERT_TRUE(converges());
    EXPECT_TRUE(showsSky(color)) << "the last binding counts";
}

TEST_F(LyingHost, SizesOfBuffersDiffer) {
    open(2);
    HdRenderBuffer *first = add(8, 6), *larger = add(16, 12), *flat = add(16, 0);
    bind({binding("color", first), binding("color", larger), binding("color", flat)});
    ASSERT_TRUE(converges());
    EXPECT_TRUE(showsSky(first));
    const std::vector<float> found = pixels(larger);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x) // what the image does not reach is black
            EXPECT_NEAR(found[size_t(y * 16 + x) * 4], x < 8 && y < 6 ? 1.0f : 0.0f, 1e-3f);
}

TEST_F(LyingHost, SaysOnceWhatIsWrongWithAName) {
    bind({binding("color", add()), binding("lpe:C<", add())});
    Warnings warnings;
    for (int i = 0; i < 20; ++i)
        execute();
    EXPECT_EQ(warnings.texts.size(), 1u);
}

TEST_F(LyingHost, BindsWhatHasSeveralLayers) {
    // So many ids are 4, 12 and 32 floats a pixel; rows of a buffer have four.
    for (int levels : {1, 6, 16}) {
        open(2);
        delegate->SetRenderSetting(TfToken("cryptomatteLevels"), VtValue(levels));
        HdRenderBuffer* color = bindColor();
        for (const char* aov : {"cryptoObject", "cryptoMaterial", "cryptoAsset"}) {
            HdRenderPassAovBindingVector bindings = state->GetAovBindings();
            bindings.push_back(binding(aov, add()));
            bindings.back().clearValue = VtValue(clearColor);
            bind(bindings);
        }
        Warnings warnings;
        ASSERT_TRUE(converges());
        execute();
        EXPECT_EQ(warnings.of("has several layers; its buffer stays empty"), 3);
        EXPECT_TRUE(showsSky(color));
        for (size_t i = buffers.size() - 3; i < buffers.size(); ++i)
            expectClear(buffers[i], std::to_string(levels) + " levels");
    }
}

TEST_F(LyingHost, HasACameraOfThePathThatPassesTake) {
    auto camera = makePrim<Camera>("/patinaView1");
    camera->focalLength = 77.0f;
    param().set<Camera>(camera);
    param().commit();
    bind({binding("color", add())});
    execute(); // by matrices, and so through a camera of the pass
    const auto focalLength = [&] {
        const auto scene = param().scene()->snapshot();
        const auto found = scene->cameras.find("/patinaView1");
        return found == scene->cameras.end() ? 0.0f : found->second->focalLength;
    };
    EXPECT_EQ(focalLength(), 77.0f);
    EXPECT_EQ(param().scene()->snapshot()->cameras.size(), 2u);
    pass.reset();
    EXPECT_EQ(focalLength(), 77.0f);
}

TEST_F(LyingHost, GivesAUnitThatIsNoNumber) {
    const TfToken name("stageMetersPerUnit");
    const auto unit = [&] {
        param().commit();
        return param().scene()->snapshot()->metersPerUnit;
    };
    delegate->SetRenderSetting(name, VtValue(0.5));
    EXPECT_EQ(unit(), 0.5);
    Warnings warnings;
    delegate->SetRenderSetting(name, VtValue(std::string("abc")));
    EXPECT_EQ(unit(), 0.5);
    EXPECT_EQ(warnings.of("stageMetersPerUnit has a value of the wrong type"), 1);
    delegate->SetRenderSetting(name, VtValue(2)); // whole numbers are numbers
    EXPECT_EQ(unit(), 2.0);
}

TEST_F(LyingHost, LooksBesideTheBuffer) {
    open(2);
    HdRenderBuffer* color = bindColor();
    ASSERT_TRUE(converges());
    ASSERT_TRUE(showsSky(color));
    constexpr int most = std::numeric_limits<int>::max();
    const GfRect2i outside[] = {GfRect2i(GfVec2i(16, 0), 4, 4), GfRect2i(GfVec2i(-9, -9), 4, 4),
                                GfRect2i(GfVec2i(0, most - 4), 4, 4)};
    for (const GfRect2i& window : outside) {
        state->SetFraming(CameraUtilFraming(GfRange2f(GfVec2f(0), GfVec2f(16, 12)), window));
        ASSERT_TRUE(converges());
        expectClear(color, "nothing is to be drawn");
    }
    // Partly outside: what is inside is drawn.
    state->SetFraming(CameraUtilFraming(GfRange2f(GfVec2f(0), GfVec2f(16, 12)),
                                        GfRect2i(GfVec2i(-5, -5), most / 2, most / 2)));
    ASSERT_TRUE(converges());
    EXPECT_TRUE(showsSky(color));
}

TEST_F(LyingHost, FramesWhatIsNoWindow) {
    open(2);
    HdRenderBuffer* color = add();
    const float nan = std::numeric_limits<float>::quiet_NaN(), most = 3e38f;
    const GfRange2f displays[] = {GfRange2f(GfVec2f(nan), GfVec2f(nan)), GfRange2f(),
                                  GfRange2f(GfVec2f(-most), GfVec2f(most)),
                                  GfRange2f(GfVec2f(1), GfVec2f(1 + 1e-7f)),
                                  GfRange2f(GfVec2f(16, 12), GfVec2f(0))};
    for (const GfRange2f& display : displays)
        for (float aspect : {1.0f, 0.0f, -1.0f, nan, most}) {
            state->SetFraming(CameraUtilFraming(display, GfRect2i(GfVec2i(0), 16, 12), aspect));
            bind({binding("color", color)});
            TfErrorMark errors; // a render that is refused says so
            EXPECT_TRUE(converges());
            bind({}); // the framing's size alone
            EXPECT_TRUE(converges());
            errors.Clear();
        }
    // Neither buffers nor framing; a viewport that is none.
    state->SetFraming(CameraUtilFraming());
    bind({});
    for (float size : {nan, most, -most, 0.0f}) {
        state->SetViewport(GfVec4d(0.0, 0.0, size, size));
        TfErrorMark errors;
        EXPECT_TRUE(converges());
        errors.Clear();
    }
    frame(16, 12);
    bind({binding("color", color)});
    ASSERT_TRUE(converges());
    EXPECT_TRUE(showsSky(color));
}

TEST_F(LyingHost, AsksForMorePixelsThanThereCanBe) {
    HdRenderBuffer* color = add();
    constexpr int most = std::numeric_limits<int>::max();
    // Bytes of the second, and only of that, are less than 2^64 again.
    for (const GfVec3i& size :
         {GfVec3i(most, most, 1), GfVec3i(1 << 30, 1 << 30, 1), GfVec3i(1 << 30, 1 << 5, 1)}) {
        Warnings warnings;
        EXPECT_FALSE(color->Allocate(size, HdFormatFloat32Vec4, false));
        EXPECT_EQ(warnings.texts.size(), 1u);
        EXPECT_EQ(color->GetWidth(), 0u);
        EXPECT_EQ(color->Map(), nullptr);
        color->Unmap();
    }
    EXPECT_FALSE(color->Allocate(GfVec3i(4, 4, 1), HdFormat(9999), false));
    bind({binding("color", color)});
    execute();
    color->Allocate(GfVec3i(16, 12, 1), HdFormatFloat32Vec4, false);
    EXPECT_TRUE(waitForSky(color));
}

/// Reads on a thread of its own, while the pass writes and allocates on the host's.
TEST_F(LyingHost, ReadsWhileItIsWritten) {
    HdRenderBuffer* color = bindColor();
    std::atomic<bool> done{false};
    std::atomic<int> torn{0}, reads{0};
    std::thread reader([&] {
        while (!done) {
            const auto* data = static_cast<const float*>(color->Map());
            const std::vector<float> before(data, data + 16 * 12 * 4);
            std::this_thread::sleep_for(std::chrono::microseconds(200));
            torn += !std::equal(before.begin(), before.end(), data);
            ++reads;
            color->Unmap();
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    });
    for (int i = 0; i < 400 || (reads < 100 && i < 20000); ++i) {
        setSky(float(i % 7));
        execute();
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    done = true;
    reader.join();
    EXPECT_GT(reads, 0);
    EXPECT_EQ(torn, 0) << "pixels change while they are mapped";
}

/// Allocates on a thread of its own.
TEST_F(LyingHost, AllocatesWhileItIsWritten) {
    HdRenderBuffer* color = bindColor();
    std::atomic<bool> done{false};
    std::thread allocator([&] {
        for (int i = 0; !done; ++i) {
            const int size = 1 + (i * 7) % 40;
            color->Allocate(GfVec3i(size, 41 - size, 1),
                            i % 2 ? HdFormatFloat32Vec4 : HdFormatFloat16Vec4, false);
            std::this_thread::sleep_for(std::chrono::microseconds(300));
        }
    });
    for (int i = 0; i < 400; ++i)
        execute();
    done = true;
    allocator.join();
    color->Allocate(GfVec3i(16, 12, 1), HdFormatFloat32Vec4, false);
    EXPECT_TRUE(waitForSky(color));
}

TEST_F(LyingHost, TakesItselfDownInTheWrongOrder) {
    HdRenderBuffer* color = bindColor();
    ASSERT_TRUE(waitForSky(color)); // and the render goes on
    HdRenderPassSharedPtr second = delegate->CreateRenderPass(index.get(), HdRprimCollection());
    second->Execute(state, {HdRenderTagTokens->geometry});
    drop(color);
    index.reset();
    delegate.reset();
    pass.reset();
    second.reset();
}

TEST(LyingHostTimes, TimesThatDoNotAscendAreNoMotion) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> all[] = {{0.0f, nan}, {nan, 1.0f}, {1.0f, 0.0f}, {0.5f, 0.5f}, {0.0f}};
    for (const std::vector<float>& times : all) {
        bool mistaken = false;
        const auto sampled = sampledOf(times, std::vector<int>{3, 4}, &mistaken);
        EXPECT_EQ(mistaken, times.size() == 2 && times[0] != times[1]);
        EXPECT_EQ(sampled.values, std::vector<int>{3});
        EXPECT_EQ(sampled.times.size(), 1u);
    }
    EXPECT_EQ(sampledOf({0.0f, 1.0f}, std::vector<int>{3, 4}).values.size(), 2u);
}

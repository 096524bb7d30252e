// SPDX-License-Identifier: Apache-2.0
// Uses of a delegate by hosts besides rendering: they close it half way, make another one, take it
// apart in any order, resize it to nothing, pause and stop it.

#include "testenv/hydra/edits/baseStage.h"
#include "testenv/hydra/tests/comparing.h"

#include <pxr/imaging/hd/rendererPluginRegistry.h>
#include <pxr/usd/usdGeom/sphere.h>

#include <chrono>
#include <thread>

using namespace patina;

namespace {

HostOptions optionsFor(bool sceneIndex, int samples) {
    HostOptions options;
    options.sceneIndex = sceneIndex;
    options.width = options.height = 32;
    options.camera = SdfPath("/World/cameras/main");
    options.settings[TfToken("samples")] = VtValue(samples);
    return options;
}

/// More samples than any test waits for.
constexpr int endless = 1 << 30;

class HydraLifetime : public testing::TestWithParam<bool> {
protected:
    HostOptions options(int samples) const { return optionsFor(GetParam(), samples); }
};

bool isBlack(const HostImage& image) {
    for (float value : image.values)
        if (value != 0.0f) return false;
    return true;
}

/// Executes until the picture shows something. @returns false after 60 seconds
bool waitForPicture(Host& host) {
    for (int i = 0; i < 60000; ++i) {
        host.execute();
        if (!isBlack(host.read("color"))) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

} // namespace

TEST_P(HydraLifetime, ClosesWhileRendering) {
    for (int repaints = 0; repaints < 6; ++repaints) {
        Host host(makeBaseStage(), options(endless));
        for (int i = 0; i < repaints; ++i)
            host.execute();
    }
    Host host(makeBaseStage(), options(endless));
    EXPECT_TRUE(waitForPicture(host)); // and then closes
}

TEST_P(HydraLifetime, TwoDelegatesShareNothing) {
    const UsdStageRefPtr first = makeBaseStage(), second = makeBaseStage();
    UsdGeomSphere(second->GetPrimAtPath(SdfPath("/World/geometry/sphere")))
        .GetRadiusAttr()
        .Set(1.0);
    auto a = std::make_unique<Host>(first, options(2));
    Host b(second, options(2)), alone(second, options(2));
    ASSERT_TRUE(a->render());
    b.execute();
    const HostImage picture = a->read("color");
    a.reset(); // while b renders
    ASSERT_TRUE(b.render());
    ASSERT_TRUE(alone.render());
    EXPECT_NE(differentPixels(picture, b.read("color")), 0);
    EXPECT_EQ(differentPixels(alone.read("color"), b.read("color")), 0);
}

TEST_P(HydraLifetime, ComesApartInAnyOrder) {
    using Part = void (Host::*)();
    std::vector<Part> parts = {&Host::dropTask, &Host::dropInput, &Host::dropBuffers};
    const std::vector<std::vector<int>> orders = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                                  {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const std::vector<int>& order : orders) {
        Host host(makeBaseStage(), options(endless));
        for (int i = 0; i < 3; ++i)
            host.execute();
        for (int part : order)
            (host.*parts[size_t(part)])();
    }
}

TEST_P(HydraLifetime, ResizesToNothingAndBack) {
    Host host(makeBaseStage(), options(2));
    ASSERT_TRUE(host.render());
    const HostImage before = host.read("color");
    EXPECT_FALSE(isBlack(before));
    for (const auto& size : {std::pair<int, int>{0, 0}, {0, 5}, {5, 0}, {1, 1}, {100, 3}}) {
        host.setSize(size.first, size.second);
        ASSERT_TRUE(host.render()) << size.first << " x " << size.second;
        const HostImage image = host.read("color");
        EXPECT_EQ(image.values.size(), size_t(size.first) * size_t(size.second) * 4);
    }
    host.setSize(32, 32);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(differentPixels(host.read("color"), before), 0);
}

TEST_P(HydraLifetime, OutputsChangeOnTheFly) {
    Host host(makeBaseStage(), options(2));
    ASSERT_TRUE(host.render());
    const HostImage before = host.read("color");
    host.setAovs({{"depth", HdFormatFloat32}, {"primId", HdFormatInt32}});
    ASSERT_TRUE(host.render());
    const HostImage depth = host.read("depth");
    for (float value : depth.values) {
        EXPECT_GE(value, 0.0f);
        EXPECT_LE(value, 1.0f);
    }
    host.setAovs({});
    ASSERT_TRUE(host.render());
    host.setAovs({HostAov(), {"notAnOutput", HdFormatFloat32}, {"normal", HdFormatInvalid}});
    ASSERT_TRUE(host.render());
    EXPECT_EQ(differentPixels(host.read("color"), before), 0);
}

TEST_P(HydraLifetime, PausesAndResumes) {
    Host host(makeBaseStage(), options(endless));
    ASSERT_TRUE(waitForPicture(host));
    ASSERT_TRUE(host.delegate()->IsPauseSupported());
    EXPECT_TRUE(host.delegate()->Pause());
    EXPECT_TRUE(host.delegate()->IsPaused());
    host.execute();
    const HostImage paused = host.read("color");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    host.execute();
    host.execute();
    EXPECT_EQ(differentPixels(host.read("color"), paused), 0);
    EXPECT_FALSE(host.isConverged());
    EXPECT_TRUE(host.delegate()->Resume());
    EXPECT_FALSE(host.delegate()->IsPaused());
    host.setSetting("samples", VtValue(2));
    EXPECT_TRUE(host.render());
}

TEST_P(HydraLifetime, StopsAndRestarts) {
    Host host(makeBaseStage(), options(endless));
    ASSERT_TRUE(waitForPicture(host));
    ASSERT_TRUE(host.delegate()->IsStopSupported());
    EXPECT_TRUE(host.delegate()->Stop(true));
    EXPECT_TRUE(host.delegate()->IsStopped());
    EXPECT_TRUE(host.render(10.0)) << "a host that waits for a stopped renderer waits forever";
    host.setSetting("samples", VtValue(2));
    EXPECT_TRUE(host.delegate()->Restart());
    EXPECT_FALSE(host.delegate()->IsStopped());
    ASSERT_TRUE(host.render());
    Host fresh(makeBaseStage(), options(2));
    ASSERT_TRUE(fresh.render());
    EXPECT_EQ(differentPixels(host.read("color"), fresh.read("color")), 0);
}

TEST_P(HydraLifetime, ReportsProgress) {
    Host host(makeBaseStage(), options(4));
    ASSERT_TRUE(host.render());
    const VtDictionary stats = host.delegate()->GetRenderStats();
    EXPECT_EQ(VtDictionaryGet<int>(stats, "numCompletedSamples", VtDefault = -1), 4);
    EXPECT_EQ(VtDictionaryGet<double>(stats, "percentDone", VtDefault = -1.0), 100.0);
    EXPECT_GT(VtDictionaryGet<double>(stats, "totalClockTime", VtDefault = -1.0), 0.0);
    EXPECT_NE(VtDictionaryGet<std::string>(stats, "renderProgressAnnotation", VtDefault = ""), "");
}

TEST_P(HydraLifetime, EveryBufferFormatIsWritten) {
    Host reference(makeBaseStage(), options(2));
    ASSERT_TRUE(reference.render());
    const HostImage exact = reference.read("color");
    const std::vector<std::pair<HdFormat, float>> formats = {{HdFormatUNorm8Vec4, 0.5f / 255.0f},
                                                             {HdFormatFloat16Vec4, 1e-3f},
                                                             {HdFormatFloat32Vec4, 0.0f}};
    for (const auto& [format, tolerance] : formats) {
        Host host(makeBaseStage(), options(2));
        host.setAovs({{"color", format}});
        ASSERT_TRUE(host.render());
        const HostImage image = host.read("color");
        ASSERT_EQ(image.values.size(), exact.values.size());
        for (size_t i = 0; i < image.values.size(); ++i) {
            const float wanted = format == HdFormatUNorm8Vec4
                                     ? std::min(std::max(exact.values[i], 0.0f), 1.0f)
                                     : exact.values[i];
            EXPECT_NEAR(image.values[i], wanted, tolerance * std::max(wanted, 1.0f) * 1.001f);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Inputs, HydraLifetime, testing::Bool(), inputName);

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/fallbackRenderer.h"

#include "hdDelegate/backends/backends.h"
#include "hdDelegate/backends/tests/fakeRenderer.h"

#include <gtest/gtest.h>

using namespace patina;

namespace {

FakeRenderer::Plan plan(const std::string& name, float value, int failAfter = -1) {
    return {name, [value](int, int, std::mt19937&) { return glm::vec3(value); }, failAfter};
}

struct Work {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    std::shared_ptr<Film> film = std::make_shared<Film>();
    RenderSettings settings;

    Work() {
        settings.width = settings.height = 8;
        settings.samples = 6;
    }
};

} // namespace

TEST(Fallback, NothingIsSaidWhileTheFirstOneWorks) {
    Work s;
    FallbackRenderer renderer(std::make_unique<FakeRenderer>(plan("first", 1.0f)), "",
                              std::make_unique<FakeRenderer>(plan("second", 2.0f)));
    renderer.start(s.scene, "", s.settings, s.film);
    renderer.wait();
    EXPECT_EQ(renderer.progress().backend, "first");
    EXPECT_EQ(s.film->color(3, 3), glm::vec3(1.0f));
    EXPECT_EQ(s.scene->diagnostics().count(), 0);
}

TEST(Fallback, ALostDeviceHandsTheWholeWorkOver) {
    Work s;
    s.film->resumeToken = "first:abc";
    auto first = std::make_unique<FakeRenderer>(plan("first", 1.0f, 3));
    FakeRenderer& watched = *first;
    FallbackRenderer renderer(std::move(first), "",
                              std::make_unique<FakeRenderer>(plan("second", 2.0f)));
    int failures = 0, ends = 0;
    renderer.setListener([&](const Film&, const RenderProgress& p) {
        failures += p.failed;
        ends += p.converged;
    });
    renderer.start(s.scene, "", s.settings, s.film);
    renderer.wait();
    const RenderProgress end = renderer.progress();
    EXPECT_TRUE(end.converged);
    EXPECT_FALSE(end.failed);
    EXPECT_EQ(end.backend, "second");
    EXPECT_EQ(s.film->color(3, 3), glm::vec3(2.0f)) << "samples of both were mixed";
    EXPECT_EQ(s.film->sampleCount(0, 0), 6u);
    EXPECT_EQ(s.film->resumeToken, "second:abc");
    EXPECT_EQ(failures, 0);
    EXPECT_EQ(ends, 1);
    const auto warnings = s.scene->diagnostics().all();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].message, "the first broke; the path tracer renders instead");
    // An edit goes on with the second one and says nothing again.
    renderer.start(s.scene, "", s.settings, std::make_shared<Film>());
    renderer.wait();
    EXPECT_EQ(watched.starts, 1);
    EXPECT_EQ(s.scene->diagnostics().all()[0].count, 1);
}

TEST(Fallback, AFaultOfTheSceneIsNoReasonToTryAgain) {
    Work s;
    FakeRenderer::Plan broken = plan("first", 1.0f, 0);
    broken.deviceFails = false;
    FallbackRenderer renderer(std::make_unique<FakeRenderer>(broken), "",
                              std::make_unique<FakeRenderer>(plan("second", 2.0f)));
    renderer.start(s.scene, "", s.settings, s.film);
    renderer.wait();
    EXPECT_TRUE(renderer.progress().failed);
    EXPECT_EQ(renderer.progress().error, "the first broke");
}

TEST(Fallback, WithoutAFirstOneEverySceneIsToldOnce) {
    Work s;
    FallbackRenderer renderer(nullptr, "there is no OpenGL",
                              std::make_unique<FakeRenderer>(plan("second", 2.0f)));
    for (int i = 0; i < 3; ++i) {
        renderer.start(s.scene, "", s.settings, s.film);
        renderer.wait();
    }
    ASSERT_EQ(s.scene->diagnostics().count(), 1);
    EXPECT_EQ(s.scene->diagnostics().all()[0].count, 1);
    EXPECT_EQ(s.scene->diagnostics().all()[0].message,
              "there is no OpenGL; the path tracer renders instead");
}

TEST(Fallback, MayBeStoppedAtAnyTime) {
    Work s;
    s.settings.samples = 1 << 20;
    for (int i = 0; i < 30; ++i) {
        FallbackRenderer renderer(std::make_unique<FakeRenderer>(plan("first", 1.0f, i)), "",
                                  std::make_unique<FakeRenderer>(plan("second", 2.0f)));
        renderer.start(s.scene, "", s.settings, s.film);
        std::this_thread::sleep_for(std::chrono::microseconds(50 * i));
        if (i % 2) renderer.pause();
        if (i % 3) renderer.resume();
        renderer.stop();
        EXPECT_FALSE(renderer.isRunning());
    }
}

TEST(Backends, EveryNameMakesARenderer) {
    for (const std::string& name : backendNames())
        EXPECT_TRUE(makeBackend(name)) << name;
    EXPECT_FALSE(makeBackend("vulkan"));
}

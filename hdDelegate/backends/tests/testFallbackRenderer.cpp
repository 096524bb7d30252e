// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/fallbackRenderer.h"

#include "hdDelegate/backends/backends.h"
#include "hdDelegate/backends/tests/fakeRenderer.h"
#include "hdDelegate/renderer/tests/rendering.h"
#include "hdDelegate/scene/tests/prims.h"
#include "base/tests/testTools.h"

using namespace patina;

namespace {

FakeRenderer::Plan plan(const std::string& name, float value, int failAfter = -1) {
    return {name, [value](int, int, std::mt19937&) { return glm::vec3(value); }, failAfter};
}
std::unique_ptr<FakeRenderer> fake(const std::string& name, float value, int failAfter = -1) {
    return std::make_unique<FakeRenderer>(plan(name, value, failAfter));
}

struct Work {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    std::shared_ptr<Film> film = std::make_shared<Film>();
    RenderSettings settings = imageOf(8, 8, 6);

    void render(Renderer& renderer) { rendered(renderer, scene, settings, film); }
};

} // namespace

TEST(Fallback, NothingIsSaidWhileTheFirstOneWorks) {
    Work s;
    FallbackRenderer renderer(fake("first", 1.0f), "", fake("second", 2.0f));
    s.render(renderer);
    EXPECT_EQ(renderer.progress().backend, "first");
    EXPECT_EQ(s.film->color(3, 3), glm::vec3(1.0f));
    EXPECT_EQ(s.scene->diagnostics().count(), 0);
}

TEST(Fallback, ALostDeviceHandsTheWholeWorkOver) {
    Work s;
    s.film->resumeToken = "first:abc";
    auto first = fake("first", 1.0f, 3);
    FakeRenderer& watched = *first;
    FallbackRenderer renderer(std::move(first), "", fake("second", 2.0f));
    int failures = 0, ends = 0;
    renderer.setListener([&](const Film&, const RenderProgress& p) {
        failures += p.failed;
        ends += p.converged;
    });
    s.render(renderer);
    const RenderProgress end = renderer.progress();
    EXPECT_TRUE(end.converged);
    EXPECT_FALSE(end.failed);
    EXPECT_EQ(end.backend, "second");
    EXPECT_EQ(s.film->color(3, 3), glm::vec3(2.0f)) << "samples of both were mixed";
    EXPECT_EQ(s.film->sampleCount(0, 0), 6u);
    EXPECT_EQ(s.film->resumeToken, "second:abc");
    EXPECT_EQ(failures, 0);
    EXPECT_EQ(ends, 1);
    EXPECT_EQ(onlyMessage(s.scene->diagnostics()),
              "the first broke; the path tracer renders instead");
    // An edit goes on with the second one and says nothing again.
    s.film = std::make_shared<Film>();
    s.render(renderer);
    EXPECT_EQ(watched.starts, 1);
    EXPECT_EQ(s.scene->diagnostics().all()[0].count, 1);
}

TEST(Fallback, AFaultOfTheSceneIsNoReasonToTryAgain) {
    Work s;
    FakeRenderer::Plan broken = plan("first", 1.0f, 0);
    broken.deviceFails = false;
    FallbackRenderer renderer(std::make_unique<FakeRenderer>(broken), "", fake("second", 2.0f));
    s.render(renderer);
    EXPECT_TRUE(renderer.progress().failed);
    EXPECT_EQ(renderer.progress().error, "the first broke");
}

TEST(Fallback, WithoutAFirstOneEverySceneIsToldOnce) {
    Work s;
    FallbackRenderer renderer(nullptr, "there is no OpenGL", fake("second", 2.0f));
    for (int i = 0; i < 3; ++i)
        s.render(renderer);
    EXPECT_EQ(onlyMessage(s.scene->diagnostics()),
              "there is no OpenGL; the path tracer renders instead");
    EXPECT_EQ(s.scene->diagnostics().all()[0].count, 1);
}

TEST(Fallback, MayBeStoppedAtAnyTime) {
    Work s;
    s.settings.samples = 1 << 20;
    for (int i = 0; i < 30; ++i) {
        FallbackRenderer renderer(fake("first", 1.0f, i), "", fake("second", 2.0f));
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

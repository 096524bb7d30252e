// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/vertex.h"
#include "hdDelegate/renderer/renderer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

using namespace patina;

namespace {

std::shared_ptr<Scene> furnaceScene() {
    auto scene = std::make_shared<Scene>();
    SceneEdit edit = scene->edit();
    auto ball = std::make_shared<Implicit>();
    ball->path = "/ball";
    edit.set(std::shared_ptr<const Geometry>(ball));
    auto dome = std::make_shared<Light>();
    dome->path = "/dome";
    dome->type = LightType::Dome;
    edit.set(std::shared_ptr<const Light>(dome));
    auto camera = std::make_shared<Camera>();
    camera->path = "/camera";
    camera->transform.values[0][3] = glm::vec4(0, 0, 5, 1);
    edit.set(std::shared_ptr<const Camera>(camera));
    return scene;
}

RenderSettings smallImage(int samples) {
    RenderSettings settings;
    settings.width = 64;
    settings.height = 36;
    settings.samples = samples;
    return settings;
}

} // namespace

TEST(EmbreeRenderer, UnknownCameraFailsAndConverges) {
    auto renderer = makeRenderer("embree");
    renderer->start(furnaceScene(), "/absent", smallImage(1), std::make_shared<Film>());
    renderer->wait();
    EXPECT_TRUE(renderer->progress().failed);
    EXPECT_NE(renderer->progress().error.find("/absent"), std::string::npos);
}

TEST(EmbreeRenderer, SingularCameraFails) {
    auto scene = furnaceScene();
    for (float broken : {0.0f, NAN}) {
        auto camera = std::make_shared<Camera>();
        camera->path = "/camera";
        camera->transform.values[0][0][0] = broken;
        scene->edit().set(std::shared_ptr<const Camera>(camera));
        auto renderer = makeRenderer("embree");
        renderer->start(scene, "/camera", smallImage(1), std::make_shared<Film>());
        renderer->wait();
        EXPECT_TRUE(renderer->progress().failed);
    }
}

TEST(EmbreeRenderer, EmptyImageFails) {
    auto renderer = makeRenderer("embree");
    RenderSettings settings = smallImage(1);
    settings.height = 0;
    renderer->start(furnaceScene(), "/camera", settings, std::make_shared<Film>());
    renderer->wait();
    EXPECT_TRUE(renderer->progress().failed);
}

TEST(Integrator, WeightsOfVeryLargeDensitiesAreNumbers) {
    const float large = 1e21f, inf = INFINITY;
    EXPECT_EQ(powerHeuristic(large, 1.0f), 1.0f);
    EXPECT_EQ(powerHeuristic(1.0f, large), 0.0f);
    EXPECT_EQ(powerHeuristic(large, large), 0.5f);
    EXPECT_EQ(powerHeuristic(0.0f, large), 0.0f);
    EXPECT_EQ(powerHeuristic(1e-30f, large), 0.0f);
    EXPECT_EQ(powerHeuristic(1.0f, inf), 0.0f);
    EXPECT_EQ(powerHeuristic(inf, 1.0f), 1.0f);
    EXPECT_FLOAT_EQ(powerHeuristic(3.0f, 1.0f), 0.9f);
}

TEST(EmbreeRenderer, UnknownBackendIsNull) {
    EXPECT_EQ(makeRenderer("none"), nullptr);
}

TEST(EmbreeRenderer, PauseStopsTheSamplesAndResumeGoesOn) {
    auto renderer = makeRenderer("embree");
    auto film = std::make_shared<Film>();
    renderer->start(furnaceScene(), "/camera", smallImage(1 << 20), film);
    while (renderer->progress().samplesDone < 1)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    renderer->pause();
    const auto before = film->resolve("sampleCount");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(film->resolve("sampleCount"), before);
    renderer->resume();
    while (film->resolve("sampleCount") == before)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    renderer->stop();
    EXPECT_FALSE(renderer->isRunning());
}

TEST(EmbreeRenderer, ASlowFirstPassShowsBlocksAndEndsWithTheSameBits) {
    RenderSettings settings = smallImage(1);
    settings.width = 65; // so that blocks are cut off at the edges
    settings.height = 41;
    settings.integrator = "ambientOcclusion";
    settings.threads = 1; // so that a pass is slow on any machine
    settings.ambientOcclusionSamples = 1 << 14;
    settings.interactive = true;
    settings.seed = 7;
    std::vector<float> images[2];
    int coarse[2] = {0, 0};
    for (const bool blocks : {false, true}) {
        settings.firstBlockSize = blocks ? 8 : 1;
        auto renderer = makeRenderer("embree");
        auto film = std::make_shared<Film>();
        renderer->setListener([&](const Film& shown, const RenderProgress& progress) {
            if (progress.converged) return;
            ++coarse[blocks];
            EXPECT_EQ(progress.samplesDone, 0);
            const std::vector<float> alpha = shown.resolve("alpha");
            const std::vector<float> counts = shown.resolve("sampleCount");
            // The middle of the ball fills its block, and few pixels have a sample.
            for (int y = 16; y < 24; ++y)
                for (int x = 28; x < 36; ++x)
                    EXPECT_EQ(alpha[size_t(y * 65 + x)], 1.0f) << x << " " << y;
            EXPECT_LE(std::accumulate(counts.begin(), counts.end(), 0.0f), 33 * 21);
        });
        renderer->start(furnaceScene(), "/camera", settings, film);
        renderer->wait();
        EXPECT_EQ(film->resolve("sampleCount"), std::vector<float>(65 * 41, 1.0f));
        images[blocks] = film->resolve("color");
    }
    EXPECT_EQ(coarse[0], 0);
    EXPECT_GE(coarse[1], 1);
    EXPECT_EQ(images[0], images[1]);
}

TEST(EmbreeRenderer, AListenerThatThrowsAtTheEndFailsTheRender) {
    auto renderer = makeRenderer("embree");
    auto film = std::make_shared<Film>();
    int failures = 0;
    renderer->setListener([&](const Film&, const RenderProgress& progress) {
        failures += progress.failed;
        if (progress.converged || progress.failed) throw std::bad_alloc();
    });
    renderer->start(furnaceScene(), "/camera", smallImage(1), film);
    renderer->wait();
    const RenderProgress progress = renderer->progress();
    EXPECT_TRUE(progress.failed && progress.temporary && !progress.converged);
    EXPECT_EQ(progress.error, "out of memory");
    EXPECT_EQ(failures, 1);
}

TEST(EmbreeRenderer, PausedStoppedAndResumedGivesTheSameBits) {
    auto whole = std::make_shared<Film>(), cut = std::make_shared<Film>();
    auto renderer = makeRenderer("embree");
    renderer->start(furnaceScene(), "/camera", smallImage(40), whole);
    renderer->wait();
    cut->resumeToken = "the same render";
    renderer->start(furnaceScene(), "/camera", smallImage(40), cut);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    renderer->pause();
    renderer->resume();
    renderer->stop();
    renderer->start(furnaceScene(), "/camera", smallImage(40), cut);
    renderer->wait();
    EXPECT_TRUE(renderer->progress().converged);
    EXPECT_EQ(whole->resolve("color"), cut->resolve("color"));
}

TEST(EmbreeRenderer, EditsBetweenRendersGiveTheImageOfAFreshOne) {
    auto scene = furnaceScene();
    auto renderer = makeRenderer("embree");
    renderer->start(scene, "/camera", smallImage(4), std::make_shared<Film>());
    renderer->wait();
    auto second = std::make_shared<Implicit>();
    second->path = "/second";
    second->transform.values[0][3] = glm::vec4(0.5f, 0.5f, 1, 1);
    scene->edit().set(std::shared_ptr<const Geometry>(second));
    auto edited = std::make_shared<Film>(), fresh = std::make_shared<Film>();
    renderer->start(scene, "/camera", smallImage(4), edited);
    renderer->wait();
    auto other = makeRenderer("embree");
    other->start(scene, "/camera", smallImage(4), fresh);
    other->wait();
    EXPECT_EQ(edited->resolve("color"), fresh->resolve("color"));
}

TEST(EmbreeRenderer, ManyStartsAndStopsAreSafe) {
    auto scene = furnaceScene();
    auto renderer = makeRenderer("embree");
    auto film = std::make_shared<Film>();
    for (int i = 0; i < 20; ++i) {
        renderer->start(scene, "/camera", smallImage(1 << 16), film);
        std::this_thread::sleep_for(std::chrono::milliseconds(i));
    }
    renderer->stop();
    SUCCEED();
}

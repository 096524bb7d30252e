// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/vertex.h"
#include "hdDelegate/renderer/tests/rendering.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

using namespace patina;

namespace {

std::shared_ptr<Scene> furnaceScene() {
    return sceneOf(makePrim<Implicit>("/ball"), makeLight("/dome", LightType::Dome),
                   makePrim<Camera>("/camera", translate(0, 0, 5)));
}

RenderSettings smallImage(int samples) {
    return imageOf(64, 36, samples);
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
        auto camera = makePrim<Camera>("/camera");
        camera->transform.values[0][0][0] = broken;
        scene->edit().set(camera);
        auto renderer = makeRenderer("embree");
        rendered(*renderer, scene, smallImage(1));
        EXPECT_TRUE(renderer->progress().failed);
    }
}

TEST(EmbreeRenderer, EmptyImageFails) {
    auto renderer = makeRenderer("embree");
    rendered(*renderer, furnaceScene(), imageOf(64, 0, 1));
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
    RenderSettings settings = imageOf(65, 41, 1); // so that blocks are cut off at the edges
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
        const auto film = rendered(*renderer, furnaceScene(), settings);
        EXPECT_EQ(film->resolve("sampleCount"), std::vector<float>(65 * 41, 1.0f));
        images[blocks] = film->resolve("color");
    }
    EXPECT_EQ(coarse[0], 0);
    EXPECT_GE(coarse[1], 1);
    EXPECT_EQ(images[0], images[1]);
}

TEST(EmbreeRenderer, AListenerThatThrowsAtTheEndFailsTheRender) {
    auto renderer = makeRenderer("embree");
    int failures = 0;
    renderer->setListener([&](const Film&, const RenderProgress& progress) {
        failures += progress.failed;
        if (progress.converged || progress.failed) throw std::bad_alloc();
    });
    rendered(*renderer, furnaceScene(), smallImage(1));
    const RenderProgress progress = renderer->progress();
    EXPECT_TRUE(progress.failed && progress.temporary && !progress.converged);
    EXPECT_EQ(progress.error, "out of memory");
    EXPECT_EQ(failures, 1);
}

TEST(EmbreeRenderer, PausedStoppedAndResumedGivesTheSameBits) {
    auto renderer = makeRenderer("embree");
    const auto whole = rendered(*renderer, furnaceScene(), smallImage(40)),
               cut = std::make_shared<Film>();
    cut->resumeToken = "the same render";
    renderer->start(furnaceScene(), "/camera", smallImage(40), cut);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    renderer->pause();
    renderer->resume();
    renderer->stop();
    rendered(*renderer, furnaceScene(), smallImage(40), cut);
    EXPECT_TRUE(renderer->progress().converged);
    EXPECT_EQ(whole->resolve("color"), cut->resolve("color"));
}

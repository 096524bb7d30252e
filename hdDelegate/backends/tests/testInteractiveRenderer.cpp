// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/interactiveRenderer.h"
#include "hdDelegate/scene/tests/prims.h"
#include "base/tests/testTools.h"

#include "hdDelegate/backends/tests/fakeRenderer.h"
#include "hdDelegate/renderer/tests/rendering.h"

#include <new>

using namespace patina;

namespace {

/// A dark image without noise, as a rasterizer's.
glm::vec3 direct(int x, int y, std::mt19937&) {
    return ((x / 4 + y / 4) % 2 ? 0.3f : 0.1f) * glm::vec3(1.0f, 0.8f, 0.6f);
}

/// The same with more light of another colour, and noise.
glm::vec3 whole(int x, int y, std::mt19937& random) {
    std::exponential_distribution<float> noise(1.0f);
    return (direct(x, y, random) + glm::vec3(0.2f, 0.4f, 0.5f)) * noise(random);
}

struct Session {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    std::shared_ptr<Film> film = std::make_shared<Film>();
    RenderSettings settings;
    FakeRenderer *quick, *slow;
    std::unique_ptr<InteractiveRenderer> renderer;
    std::vector<Picture> shown;
    std::vector<float> depths;
    std::vector<RenderProgress> reported;

    std::vector<bool> onDevice;
    std::atomic<bool> listening{false};

    explicit Session(int quickFails = -1, int quickWait = 0, bool device = false) {
        settings = imageOf(70, 50, 12);
        settings.aovs = {"depth"};
        auto a = std::make_unique<FakeRenderer>(
            FakeRenderer::Plan{"raster", direct, quickFails, true, quickWait, device});
        auto b = std::make_unique<FakeRenderer>(FakeRenderer::Plan{"slow", whole, -1, true, 10});
        quick = a.get();
        slow = b.get();
        renderer = std::make_unique<InteractiveRenderer>(std::move(a), std::move(b));
        renderer->letImagesStay(device);
        renderer->setListener([this](const Film& f, const RenderProgress& p) {
            EXPECT_FALSE(listening.exchange(true)) << "by two threads";
            onDevice.push_back(f.source() != nullptr);
            if (!p.failed) {
                Film copy;
                copy.copyFrom(f);
                shown.push_back(pictureOf(copy));
                depths.push_back(copy.resolve("depth")[0]);
            }
            reported.push_back(p);
            listening = false;
        });
    }

    void render() { rendered(*renderer, scene, settings, film); }
    /// From frame to frame there is none.
    void expectNoJump() const {
        for (size_t i = 1; i < shown.size(); ++i)
            EXPECT_LE(largestStep(shown[i - 1], shown[i]),
                      InteractiveRenderer::largestChange * 1.001f)
                << i;
    }

    /// The image that the slow renderer alone makes.
    Picture reference() const {
        FakeRenderer alone(FakeRenderer::Plan{"slow", whole});
        return pictureOf(*rendered(alone, scene, settings));
    }
};

} // namespace

TEST(Interactive, TheQuickImageComesFirstAndTheSlowOneLastWithoutAJump) {
    Session s;
    s.render();
    ASSERT_GT(s.shown.size(), 3u);
    std::mt19937 random;
    EXPECT_EQ(s.shown[0].pixels[0], glm::vec4(direct(0, 0, random), 1.0f));
    EXPECT_EQ(s.reported[0].backend, "raster");
    // From end to end it is a jump, from frame to frame it is none.
    EXPECT_GT(largestStep(s.shown.front(), s.shown.back()),
              3.0f * InteractiveRenderer::largestChange);
    s.expectNoJump();
    EXPECT_EQ(s.shown.back().pixels, s.reference().pixels);
    EXPECT_EQ(pictureOf(*s.film).pixels, s.reference().pixels);
    for (size_t i = 0; i + 1 < s.reported.size(); ++i)
        EXPECT_FALSE(s.reported[i].converged) << "only the last frame is whole";
    EXPECT_TRUE(s.reported.back().converged);
    EXPECT_EQ(s.reported.back().backend, "slow");
    EXPECT_EQ(s.depths.front(), 1.0f);
    EXPECT_EQ(s.depths.back(), 2.0f);
    EXPECT_TRUE(std::is_sorted(s.depths.begin(), s.depths.end())) << "AOVs went back";
}

TEST(Interactive, ImagesOnADeviceAreShownUntilThereAreSamples) {
    Session s(-1, 3, true);
    s.render();
    ASSERT_GT(s.shown.size(), 3u);
    EXPECT_TRUE(s.onDevice.front());
    EXPECT_FALSE(s.onDevice.back());
    EXPECT_TRUE(std::is_sorted(s.onDevice.rbegin(), s.onDevice.rend())) << "they came again";
    std::mt19937 random;
    EXPECT_EQ(s.shown[0].pixels[0], glm::vec4(direct(0, 0, random), 1.0f));
    s.expectNoJump();
    EXPECT_EQ(s.shown.back().pixels, s.reference().pixels);
}

TEST(Interactive, APairEndsWhereTheDeviceFailsAfterAnImage) {
    Session s(1, 3, true);
    s.render();
    EXPECT_TRUE(s.onDevice.front());
    EXPECT_TRUE(s.reported.back().converged);
    EXPECT_EQ(s.shown.back().pixels, s.reference().pixels);
}

TEST(Interactive, CamerasThatOnlyRaysShowAreTracedFromTheStart) {
    Session s;
    auto camera = makePrim<Camera>("/camera");
    camera->lens.projection = LensProjection::Spherical;
    s.scene->edit().set(camera);
    s.renderer->start(s.scene, "/camera", s.settings, s.film);
    s.renderer->wait();
    EXPECT_EQ(s.quick->starts, 0);
    EXPECT_EQ(pictureOf(*s.film).pixels, s.reference().pixels);
}

TEST(Interactive, EditsStartWithTheQuickImageAgain) {
    Session s;
    s.settings.samples = 1000;
    for (int i = 0; i < 3; ++i) {
        s.renderer->start(s.scene, "", s.settings, s.film);
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        s.renderer->stop();
        EXPECT_FALSE(s.renderer->isRunning());
        ASSERT_FALSE(s.reported.empty());
        EXPECT_EQ(s.reported.front().backend, "raster");
        EXPECT_FALSE(s.reported.back().converged);
        s.reported.clear();
    }
    EXPECT_EQ(s.quick->starts, 3);
}

TEST(Interactive, AQuickRendererWithoutADeviceIsLeftOut) {
    Session s(0);
    s.render();
    EXPECT_TRUE(s.reported.back().converged);
    for (const RenderProgress& p : s.reported)
        EXPECT_EQ(p.backend, "slow");
    EXPECT_EQ(s.shown.back().pixels, s.reference().pixels);
    EXPECT_EQ(onlyMessage(s.scene->diagnostics()),
              "the raster broke; the path tracer goes on without a first image");
    s.render();
    EXPECT_EQ(s.quick->starts, 1);
    EXPECT_EQ(s.scene->diagnostics().all()[0].count, 1);
}

TEST(Interactive, ALateQuickImageHoldsNothingUp) {
    Session s(-1, 400);
    s.render();
    EXPECT_EQ(s.reported.front().backend, "slow");
    EXPECT_EQ(s.shown.back().pixels, s.reference().pixels);
}

TEST(Interactive, PausedAndStoppedAtAnyTime) {
    Session s;
    s.settings.samples = 200;
    for (int i = 0; i < 12; ++i) {
        s.renderer->start(s.scene, "", s.settings, s.film);
        std::this_thread::sleep_for(std::chrono::milliseconds(7 * i));
        s.renderer->pause();
        if (i % 2) s.renderer->resume();
        if (i % 3) s.renderer->stop();
        EXPECT_FALSE(i % 3 && s.renderer->isRunning());
    }
}

TEST(Interactive, AListenerThatThrowsFailsTheRenderAndLetsTheFilmRest) {
    Session s;
    int told = 0;
    s.renderer->setListener([&](const Film&, const RenderProgress& p) {
        told += p.failed;
        throw std::bad_alloc();
    });
    s.render();
    const RenderProgress progress = s.renderer->progress();
    EXPECT_TRUE(progress.failed && progress.temporary);
    EXPECT_EQ(progress.error, "out of memory");
    EXPECT_EQ(told, 1);
    EXPECT_FALSE(s.quick->isRunning() || s.slow->isRunning());
}

TEST(Interactive, WithoutAListenerOnlyTheSlowOneWorks) {
    Session s;
    s.renderer->setListener({});
    s.render();
    EXPECT_EQ(s.quick->starts, 0);
    EXPECT_TRUE(s.renderer->progress().converged);
    EXPECT_EQ(pictureOf(*s.film).pixels, s.reference().pixels);
}

// SPDX-License-Identifier: Apache-2.0
// The thread behind every back end.

#include "hdDelegate/renderer/renderLoop.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

#include <set>

using namespace patina;

namespace {

/// Notes the threads that render; goes on until it is stopped where there is no end.
class NotingLoop : public RenderLoop {
public:
    NotingLoop() : RenderLoop("noting") {}
    ~NotingLoop() override { stop(); }

    std::set<std::thread::id> threads;
    int renders = 0;
    bool endless = false;
    std::atomic<bool> inside{false};

protected:
    void render(const SceneState&, const Camera&) override {
        inside = true;
        threads.insert(std::this_thread::get_id());
        ++renders;
        while (endless && waitWhilePaused())
            std::this_thread::yield();
        inside = false;
    }
};

class RenderLoopThread : public testing::Test {
protected:
    RenderLoopThread() { scene->edit().set(makePrim<Camera>("/camera")); }

    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    std::shared_ptr<Film> film = std::make_shared<Film>();
    RenderSettings settings = imageOf(4, 4);
};

} // namespace

/// Embree keeps a record of each thread that has built a scene, for as long as the process lives.
TEST_F(RenderLoopThread, OneRendersThemAll) {
    NotingLoop loop;
    for (int i = 0; i < 5; ++i) {
        loop.endless = i % 2 == 0;
        loop.start(scene, "/camera", settings, film);
        if (!loop.endless) loop.wait();
        while (loop.endless && !loop.inside)
            std::this_thread::yield();
    }
    loop.stop();
    EXPECT_FALSE(loop.inside) << "stop() waits for the thread to let go of the film";
    EXPECT_FALSE(loop.isRunning());
    EXPECT_EQ(loop.renders, 5);
    EXPECT_EQ(loop.threads.size(), 1u);
}

TEST_F(RenderLoopThread, LetsGoOfTheStateWhenStopped) {
    NotingLoop loop;
    loop.endless = true;
    loop.start(scene, "/camera", settings, film);
    const std::weak_ptr<const SceneState> state = scene->snapshot();
    scene->edit().set(makePrim<Camera>("/camera"));
    EXPECT_FALSE(state.expired());
    loop.stop();
    EXPECT_TRUE(state.expired());
}

TEST_F(RenderLoopThread, EndsUnusedAndPaused) {
    { NotingLoop unused; }
    NotingLoop paused;
    paused.endless = true;
    paused.start(scene, "/camera", settings, film);
    paused.pause(); // and is destroyed
}

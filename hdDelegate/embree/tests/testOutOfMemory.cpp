// SPDX-License-Identifier: Apache-2.0
// Updates of a scene that run out of memory anywhere: the next one makes whole what they did not.

#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/embree/tests/builtScene.h"
#include "hdDelegate/renderer/renderLoop.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {
/// Allocations of this thread until one fails; negative: none does.
thread_local long allocationsLeft = -1;
} // namespace

// One of these inlined without its partner looks to g++ as if new and free were mixed.
__attribute__((noinline)) void* operator new(std::size_t size) {
    if (allocationsLeft >= 0 && allocationsLeft-- == 0) throw std::bad_alloc();
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void* memory) noexcept {
    std::free(memory);
}
__attribute__((noinline)) void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

using namespace patina;

namespace {

std::shared_ptr<Mesh> square(const std::string& path, float x, const std::string& group = "") {
    return makeQuad(path, group, vec2(x, 0));
}

/// The path of the prim that rays along a line meet, or nothing.
std::vector<std::string> seen(const EmbreeScene& scene) {
    std::vector<std::string> paths;
    for (float x = -12.0f; x <= 12.0f; x += 1.5f) {
        Hit hit;
        const bool met = scene.intersect(vec3(x, 0.1f, 5.0f), vec3(0, 0, -1), 0.0f, 100.0f, 0.5f,
                                         RayCamera, hit);
        paths.push_back(met ? hit.surface->prim->path : "");
    }
    return paths;
}

class OutOfMemory : public testing::TestWithParam<bool> {};

} // namespace

TEST_P(OutOfMemory, TheNextUpdateMakesWholeWhatAnEditDidNot) {
    const auto scene =
        sceneOf(square("/leaf", 0.0f, "leaves"),
                makeInstancer("/leaves", "", "leaves",
                              {translate(-3, 0, 0), translate(-6, 0, 0), translate(-9, 0, 0)}));
    for (int i = 0; i < 4; ++i)
        scene->edit().set(square("/prim" + std::to_string(i), 3.0f * float(i)));
    const auto before = scene->snapshot();
    {
        SceneEdit edit = scene->edit();
        for (const auto& prim :
             {square("/prim1", 1.5f), square("/leaf", 0.7f, "leaves"), square("/prim9", 7.5f)})
            edit.set(prim);
        edit.remove("/prim2");
    }
    const auto after = scene->snapshot();
    const auto compiled = CompiledScene::of(scene);
    RenderSettings settings;
    settings.interactive = GetParam();
    const std::atomic<bool> stop{false};
    const Camera camera;
    const auto fresh = [&] {
        EmbreeScene scene(*compiled);
        scene.update(*after, camera, settings, stop);
        return seen(scene);
    }();
    ASSERT_GT(std::count(fresh.begin(), fresh.end(), "/leaf"), 0);
    ASSERT_GT(std::count(fresh.begin(), fresh.end(), "/prim9"), 0);
    int failures = 0;
    bool reached = true;
    for (long at = 0; reached; at += 1 + at / 8) {
        EmbreeScene scene(*compiled);
        scene.update(*before, camera, settings, stop);
        allocationsLeft = at;
        bool failed = false;
        try {
            scene.update(*after, camera, settings, stop);
        } catch (const std::bad_alloc&) {
            failed = true;
        }
        reached = allocationsLeft < 0;
        allocationsLeft = -1;
        failures += failed;
        scene.update(*after, camera, settings, stop);
        EXPECT_EQ(seen(scene), fresh) << "after allocation " << at << " failed";
    }
    EXPECT_GT(failures, 20);
}

INSTANTIATE_TEST_SUITE_P(, OutOfMemory, testing::Bool(), [](const auto& info) {
    return std::string(info.param ? "interactive" : "final");
});

namespace {

/// Has no memory once it has rendered.
class LoopWithoutMemory : public RenderLoop {
public:
    explicit LoopWithoutMemory(long allocations) : RenderLoop("none"), _allocations(allocations) {}
    ~LoopWithoutMemory() override { stop(); }

protected:
    void render(const SceneState&, const Camera&) override {
        report([](RenderProgress& progress) {
            progress.statistics["a name that takes memory of its own"] = 1.0;
        });
        allocationsLeft = _allocations;
    }

private:
    long _allocations;
};

} // namespace

TEST(RenderWithoutMemory, ItsEndTellsOfIt) {
    const auto scene = sceneOf(makePrim<Camera>("/camera"));
    for (const long at : {0L, 1L, 100L}) {
        LoopWithoutMemory loop(at);
        loop.start(scene, "/camera", RenderSettings(), std::make_shared<Film>());
        loop.wait();
        const RenderProgress last = loop.progress();
        EXPECT_EQ(last.failed, at < 100) << at;
        EXPECT_EQ(last.error, at < 100 ? "out of memory" : "") << at;
    }
}

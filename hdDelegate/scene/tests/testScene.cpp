// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/scene.h"

#include "base/limits.h"

#include <gtest/gtest.h>

#include <limits>

#include <thread>

namespace patina {
namespace {

std::shared_ptr<Mesh> meshAt(const std::string& path) {
    auto mesh = std::make_shared<Mesh>();
    mesh->path = path;
    return mesh;
}

TEST(Scene, commitMakesAnotherStateAndKeepsTheOldOne) {
    Scene scene;
    const auto before = scene.snapshot();
    const auto mesh = meshAt("/a");
    {
        SceneEdit edit = scene.edit();
        edit.set(std::shared_ptr<const Geometry>(mesh));
        EXPECT_EQ(scene.snapshot(), before) << "nothing shows before the commit";
    }
    const auto after = scene.snapshot();
    EXPECT_TRUE(before->geometry.empty());
    ASSERT_EQ(after->geometry.count("/a"), 1u);
    EXPECT_EQ(after->geometry.at("/a"), mesh);
    EXPECT_GT(after->version, before->version);
}

TEST(Scene, editsWithoutEffectKeepTheState) {
    Scene scene;
    const auto mesh = meshAt("/a");
    scene.edit().set(std::shared_ptr<const Geometry>(mesh));
    const auto state = scene.snapshot();
    scene.edit().commit();
    scene.edit().set(std::shared_ptr<const Geometry>(mesh));
    scene.edit().remove("/missing");
    scene.edit().setMetersPerUnit(state->metersPerUnit);
    {
        SceneEdit edit = scene.edit();
        edit.clear();
        edit.set(std::shared_ptr<const Geometry>(mesh));
    }
    EXPECT_EQ(scene.snapshot(), state);
}

TEST(Scene, unchangedPrimsKeepTheirObjects) {
    Scene scene;
    scene.edit().set(std::shared_ptr<const Geometry>(meshAt("/a")));
    const auto first = scene.snapshot()->geometry.at("/a");
    scene.edit().set(std::shared_ptr<const Geometry>(meshAt("/b")));
    EXPECT_EQ(scene.snapshot()->geometry.at("/a"), first);
    EXPECT_EQ(scene.snapshot()->geometry.size(), 2u);
}

TEST(Scene, theLastCallOfAnEditCounts) {
    Scene scene;
    {
        SceneEdit edit = scene.edit();
        edit.set(std::shared_ptr<const Geometry>(meshAt("/a")));
        edit.remove("/a");
        edit.remove("/b");
        edit.set(std::shared_ptr<const Geometry>(meshAt("/b")));
    }
    EXPECT_EQ(scene.snapshot()->geometry.count("/a"), 0u);
    EXPECT_EQ(scene.snapshot()->geometry.count("/b"), 1u);
}

TEST(Scene, removeTakesEveryKindOfPrim) {
    Scene scene;
    auto light = std::make_shared<Light>();
    light->path = "/a";
    {
        SceneEdit edit = scene.edit();
        edit.set(std::shared_ptr<const Geometry>(meshAt("/a")));
        edit.set(std::shared_ptr<const Light>(light));
    }
    EXPECT_EQ(scene.snapshot()->lights.size(), 1u);
    scene.edit().remove("/a");
    EXPECT_TRUE(scene.snapshot()->geometry.empty());
    EXPECT_TRUE(scene.snapshot()->lights.empty());
}

TEST(Scene, clearRemovesWhatWasThere) {
    Scene scene;
    scene.edit().set(std::shared_ptr<const Geometry>(meshAt("/a")));
    {
        SceneEdit edit = scene.edit();
        edit.clear();
        edit.set(std::shared_ptr<const Geometry>(meshAt("/b")));
    }
    EXPECT_EQ(scene.snapshot()->geometry.count("/a"), 0u);
    EXPECT_EQ(scene.snapshot()->geometry.count("/b"), 1u);
}

TEST(Scene, badMetersPerUnitIsReported) {
    Scene scene;
    scene.edit().setMetersPerUnit(0.0);
    scene.edit().setMetersPerUnit(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(scene.snapshot()->metersPerUnit, SceneState().metersPerUnit);
    EXPECT_EQ(scene.diagnostics().count(), 1);
    EXPECT_EQ(scene.diagnostics().all().at(0).input, "metersPerUnit");
}

TEST(Scene, editsFromSeveralThreadsAllArrive) {
    Scene scene;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&scene, t] {
            for (int i = 0; i < 50; ++i)
                scene.edit().set(std::shared_ptr<const Geometry>(
                    meshAt("/" + std::to_string(t) + "/" + std::to_string(i))));
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(scene.snapshot()->geometry.size(), 200u);
    EXPECT_EQ(scene.snapshot()->version, 200u);
}

std::shared_ptr<const Geometry> quads(const std::string& path, int count) {
    const auto mesh = meshAt(path);
    mesh->faceVertexCounts.assign(size_t(count), 4);
    mesh->faceVertexIndices.assign(size_t(count) * 4, 0);
    return mesh;
}

TEST(Scene, whatLeavesItBeyondItsLimitsIsLeftOutAndNamed) {
    Scene scene;
    setLimits({{"triangles", 10}});
    {
        SceneEdit edit = scene.edit();
        for (const char* path : {"/a", "/b", "/c", "/d"})
            edit.set(quads(path, 2)); // 4 triangles
    }
    EXPECT_EQ(scene.snapshot()->geometry.size(), 2u);
    EXPECT_EQ(scene.snapshot()->triangles, 8u);
    ASSERT_EQ(scene.diagnostics().count(), 1);
    EXPECT_EQ(scene.diagnostics().all()[0].prim, "/c");
    EXPECT_EQ(scene.diagnostics().all()[0].message,
              "the scene has more triangles than 10 (--limit triangles); the prim is left out, "
              "and 1 others");
    // A prim that goes makes room; a prim that is set again does not count twice.
    {
        SceneEdit edit = scene.edit();
        edit.remove("/a");
        edit.set(quads("/b", 2));
        edit.set(quads("/c", 3));
    }
    EXPECT_EQ(scene.snapshot()->triangles, 10u);
    EXPECT_EQ(scene.snapshot()->geometry.count("/c"), 1u);
    EXPECT_EQ(scene.diagnostics().count(), 1);
    {
        SceneEdit edit = scene.edit();
        edit.clear();
        edit.set(quads("/e", 5));
    }
    EXPECT_EQ(scene.snapshot()->triangles, 10u);
    setLimits({{"prims", 2}, {"textLength", 20}});
    {
        SceneEdit edit = scene.edit();
        for (const char* path : {"/f", "/g", "/a path that is longer"})
            edit.set(quads(path, 1));
    }
    EXPECT_EQ(scene.snapshot()->geometry.size(), 2u);
    EXPECT_EQ(scene.diagnostics().count(), 3);
    setLimits({});
}

} // namespace
} // namespace patina

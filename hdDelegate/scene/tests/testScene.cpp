// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/tests/prims.h"

#include "base/limits.h"
#include "base/tests/testTools.h"

#include <limits>

namespace patina {
namespace {

std::shared_ptr<Mesh> meshAt(const std::string& path) {
    return makePrim<Mesh>(path);
}

TEST(Scene, commitMakesAnotherStateAndKeepsTheOldOne) {
    Scene scene;
    const auto before = scene.snapshot();
    const auto mesh = meshAt("/a");
    {
        SceneEdit edit = scene.edit();
        edit.set(mesh);
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
    scene.edit().set(mesh);
    const auto state = scene.snapshot();
    scene.edit().commit();
    scene.edit().set(mesh);
    scene.edit().remove("/missing");
    scene.edit().setMetersPerUnit(state->metersPerUnit);
    {
        SceneEdit edit = scene.edit();
        edit.clear();
        edit.set(mesh);
    }
    EXPECT_EQ(scene.snapshot(), state);
}

TEST(Scene, unchangedPrimsKeepTheirObjects) {
    Scene scene;
    scene.edit().set(meshAt("/a"));
    const auto first = scene.snapshot()->geometry.at("/a");
    scene.edit().set(meshAt("/b"));
    EXPECT_EQ(scene.snapshot()->geometry.at("/a"), first);
    EXPECT_EQ(scene.snapshot()->geometry.size(), 2u);
}

TEST(Scene, theLastCallOfAnEditCounts) {
    Scene scene;
    {
        SceneEdit edit = scene.edit();
        edit.set(meshAt("/a"));
        edit.remove("/a");
        edit.remove("/b");
        edit.set(meshAt("/b"));
    }
    EXPECT_EQ(scene.snapshot()->geometry.count("/a"), 0u);
    EXPECT_EQ(scene.snapshot()->geometry.count("/b"), 1u);
}

TEST(Scene, removeTakesEveryKindOfPrim) {
    Scene scene;
    setPrims(scene, meshAt("/a"), makePrim<Light>("/a"));
    EXPECT_EQ(scene.snapshot()->lights.size(), 1u);
    scene.edit().remove("/a");
    EXPECT_TRUE(scene.snapshot()->geometry.empty());
    EXPECT_TRUE(scene.snapshot()->lights.empty());
}

TEST(Scene, clearRemovesWhatWasThere) {
    Scene scene;
    scene.edit().set(meshAt("/a"));
    {
        SceneEdit edit = scene.edit();
        edit.clear();
        edit.set(meshAt("/b"));
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
    onThreads(4, [&](int t) {
        for (int i = 0; i < 50; ++i)
            scene.edit().set(meshAt("/" + std::to_string(t) + "/" + std::to_string(i)));
    });
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
    setPrims(scene, quads("/a", 2), quads("/b", 2), quads("/c", 2), quads("/d", 2)); // 4 triangles
    EXPECT_EQ(scene.snapshot()->geometry.size(), 2u);
    EXPECT_EQ(scene.snapshot()->triangles, 8u);
    EXPECT_EQ(onlyWarning(scene.diagnostics()), "/c  the scene has more triangles than 10 (--limit "
                                                "triangles); the prim is left out, and 1 others");
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
    setPrims(scene, quads("/f", 1), quads("/g", 1), quads("/a path that is longer", 1));
    EXPECT_EQ(scene.snapshot()->geometry.size(), 2u);
    EXPECT_EQ(scene.diagnostics().count(), 3);
    setLimits({});
}

} // namespace
} // namespace patina

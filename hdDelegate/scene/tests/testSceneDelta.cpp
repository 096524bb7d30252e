// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

std::shared_ptr<const Geometry> mesh(const std::string& path) {
    return makePrim<Mesh>(path);
}

std::shared_ptr<const MaterialPrim> material(const std::string& path) {
    return makePrim<MaterialPrim>(path);
}

using Paths = SceneDelta::Paths;

TEST(SceneDelta, TellsWhatCommitsChanged) {
    Scene scene;
    setPrims(scene, mesh("/a"), mesh("/b"), mesh("/c"), material("/m"));
    const uint64_t before = scene.snapshot()->version;
    scene.edit().set(material("/m"));
    {
        SceneEdit edit = scene.edit();
        edit.set(mesh("/a"));
        edit.remove("/b");
        edit.remove("/missing");
        edit.set(mesh("/d"));
    }
    const auto delta = scene.changes(before, scene.snapshot()->version);
    ASSERT_TRUE(delta);
    EXPECT_EQ(delta->geometry,
              (Paths{{"/a", PrimEdit::Set}, {"/b", PrimEdit::Removed}, {"/d", PrimEdit::Added}}));
    EXPECT_EQ(delta->materials, (Paths{{"/m", PrimEdit::Set}}));
    EXPECT_TRUE(delta->instancers.empty() && delta->lights.empty() && delta->cameras.empty());
    EXPECT_EQ(delta->size(), 4u);
    const auto last = scene.changes(before + 1, before + 2);
    ASSERT_TRUE(last);
    EXPECT_TRUE(last->materials.empty()) << "that was the commit before";
}

TEST(SceneDelta, AddsUpWhatFollowsEachOther) {
    Scene scene;
    scene.edit().set(mesh("/kept"));
    const uint64_t before = scene.snapshot()->version;
    scene.edit().set(mesh("/new"));
    scene.edit().set(mesh("/new"));
    scene.edit().remove("/kept");
    scene.edit().set(mesh("/kept"));
    scene.edit().set(mesh("/short"));
    scene.edit().remove("/short");
    scene.edit().set(mesh("/twice"));
    scene.edit().remove("/twice");
    scene.edit().set(mesh("/twice"));
    scene.edit().set(mesh("/gone"));
    const uint64_t middle = scene.snapshot()->version;
    scene.edit().remove("/gone");
    const auto delta = scene.changes(before, scene.snapshot()->version);
    ASSERT_TRUE(delta);
    EXPECT_EQ(delta->geometry, (Paths{{"/kept", PrimEdit::Set},
                                      {"/new", PrimEdit::Added},
                                      {"/gone", PrimEdit::Passing},
                                      {"/short", PrimEdit::Passing},
                                      {"/twice", PrimEdit::Added}}));
    EXPECT_EQ(scene.changes(middle, scene.snapshot()->version)->geometry,
              (Paths{{"/gone", PrimEdit::Removed}}));
}

TEST(SceneDelta, IsEmptyBetweenAVersionAndItself) {
    Scene scene;
    scene.edit().set(mesh("/a"));
    const uint64_t version = scene.snapshot()->version;
    scene.edit().remove("/missing");
    scene.edit().set(scene.snapshot()->geometry.at("/a"));
    EXPECT_EQ(scene.snapshot()->version, version);
    const auto delta = scene.changes(version, version);
    ASSERT_TRUE(delta);
    EXPECT_TRUE(delta->empty());
}

TEST(SceneDelta, IsUnknownAfterAClearAndBackwards) {
    Scene scene;
    scene.edit().set(mesh("/a"));
    const uint64_t before = scene.snapshot()->version;
    {
        SceneEdit edit = scene.edit();
        edit.clear();
        edit.set(mesh("/b"));
    }
    EXPECT_FALSE(scene.changes(before, scene.snapshot()->version));
    const uint64_t cleared = scene.snapshot()->version;
    scene.edit().set(mesh("/c"));
    EXPECT_TRUE(scene.changes(cleared, cleared + 1));
    EXPECT_FALSE(scene.changes(cleared + 1, cleared));
    EXPECT_FALSE(scene.changes(cleared, cleared + 2)) << "not committed yet";
}

TEST(SceneDelta, ForgetsTheOldestBeyondItsLimits) {
    Scene scene;
    const uint64_t before = scene.snapshot()->version;
    for (size_t i = 0; i < EditLog::maxCommits; ++i)
        scene.edit().set(mesh("/a"));
    EXPECT_TRUE(scene.changes(before, scene.snapshot()->version));
    scene.edit().set(mesh("/a"));
    EXPECT_FALSE(scene.changes(before, scene.snapshot()->version));
    EXPECT_TRUE(scene.changes(before + 1, scene.snapshot()->version));

    const uint64_t small = scene.snapshot()->version;
    {
        SceneEdit edit = scene.edit();
        for (size_t i = 0; i <= EditLog::maxPaths; ++i)
            edit.set(mesh("/many/" + std::to_string(i)));
    }
    EXPECT_FALSE(scene.changes(small, small + 1)) << "as long as the scene itself";
    scene.edit().set(mesh("/a"));
    EXPECT_TRUE(scene.changes(small + 1, small + 2));
}

} // namespace
} // namespace patina

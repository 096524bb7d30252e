// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

std::shared_ptr<const Geometry> mesh(const std::string& path, const std::string& material,
                                     const std::string& ofSubset = "") {
    auto prim = makePrim<Mesh>(path);
    prim->material = material;
    if (!ofSubset.empty()) prim->subsets.push_back({path + "/subset", ofSubset, {0}});
    return prim;
}

std::shared_ptr<const MaterialPrim> material(const std::string& path) {
    return makePrim<MaterialPrim>(path);
}

struct CompiledEdits : ::testing::Test {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    CompiledScene compiled{scene};
    RenderSettings settings;
    uint64_t version = 0;

    CompiledEdits() {
        setPrims(*scene, mesh("/red", "/m/red"), mesh("/blue", "/m/blue"),
                 mesh("/both", "/m/blue", "/m/red"), mesh("/plain", ""), material("/m/red"),
                 material("/m/blue"));
        version = scene->snapshot()->version;
    }

    std::set<std::string> touched() {
        const auto state = scene->snapshot();
        const auto edits = compiled.editsSince(version, *state);
        version = state->version;
        return edits ? edits->touched : std::set<std::string>{"everything"};
    }
    CompiledState parts() { return compiled.compiled(*scene->snapshot(), settings); }
};

using Paths = std::set<std::string>;

TEST_F(CompiledEdits, TouchThePrimsOfAMaterial) {
    scene->edit().set(material("/m/red"));
    EXPECT_EQ(touched(), (Paths{"/both", "/red"}));
    scene->edit().set(mesh("/red", "/m/blue")); // the index goes along
    EXPECT_EQ(touched(), Paths{"/red"});
    scene->edit().set(material("/m/blue"));
    EXPECT_EQ(touched(), (Paths{"/blue", "/both", "/red"}));
    scene->edit().remove("/both");
    scene->edit().set(material("/m/red"));
    EXPECT_EQ(touched(), Paths()) << "a prim that is gone is touched by nothing";
    EXPECT_EQ(touched(), Paths());
}

TEST_F(CompiledEdits, OfTwoRenderersAtOtherVersionsAreTold) {
    const uint64_t old = version;
    scene->edit().set(mesh("/plain", "/m/red"));
    const auto before = scene->snapshot();
    scene->edit().set(material("/m/red"));
    EXPECT_EQ(touched(), (Paths{"/both", "/plain", "/red"}));
    const auto late = compiled.editsSince(old, *before);
    ASSERT_TRUE(late);
    EXPECT_EQ(late->touched, Paths{"/plain"});
    scene->edit().set(material("/m/blue"));
    EXPECT_EQ(touched(), (Paths{"/blue", "/both"}));
}

TEST_F(CompiledEdits, KeepThePartsThatTheyDoNotTouch) {
    const CompiledState before = parts();
    scene->edit().set(material("/m/red"));
    scene->edit().set(mesh("/plain", ""));
    scene->edit().set(makeLight("/key", LightType::Sphere));
    const CompiledState after = parts();
    EXPECT_EQ(after.placements, before.placements);
    EXPECT_EQ(after.links, before.links);
    EXPECT_EQ(after.meshLights, before.meshLights);

    auto linked = makeLight("/key", LightType::Sphere);
    linked->lightLink = "these";
    scene->edit().set(linked);
    const CompiledState withLink = parts();
    EXPECT_NE(withLink.links, before.links);
    EXPECT_EQ(withLink.links->of("these"), 0);
    EXPECT_EQ(withLink.links->of("those"), -1);
    EXPECT_EQ(withLink.meshLights, before.meshLights);

    auto glow = makeLight("/glow", LightType::Mesh);
    glow->geometry = "/red";
    scene->edit().set(glow);
    EXPECT_TRUE(parts().meshLights->names("/red"));
    EXPECT_EQ(parts().meshLights->of("/red", settings), scene->snapshot()->lights.at("/glow"));
    EXPECT_EQ(parts().placements, before.placements);

    scene->edit().set(std::make_shared<const Instancer>());
    EXPECT_NE(parts().placements, before.placements);
    const auto drawn = parts().placements;
    EXPECT_EQ(parts().placements, drawn);
    settings.excludePaths = {"/a"};
    EXPECT_NE(parts().placements, drawn);
}

TEST_F(CompiledEdits, MeshLightsThatAreOffGiveNoLight) {
    auto glow = makeLight("/glow", LightType::Mesh);
    glow->geometry = "/red";
    glow->visible = false;
    scene->edit().set(glow);
    EXPECT_TRUE(parts().meshLights->names("/red"));
    EXPECT_EQ(parts().meshLights->of("/red", settings), nullptr);
    auto on = makeLight("/glow2", LightType::Mesh);
    on->geometry = "/red";
    scene->edit().set(on);
    EXPECT_EQ(parts().meshLights->of("/red", settings), on);
    settings.enableSceneLights = false;
    EXPECT_EQ(parts().meshLights->of("/red", settings), nullptr);
}

} // namespace
} // namespace patina

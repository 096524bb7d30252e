// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/tests/builtScene.h"

#include "hdDelegate/compiled/drawFilter.h"

using namespace patina;
using namespace patina::test;

namespace {

struct Built : BuiltScene {
    bool seen(float x, unsigned rays = RayCamera) {
        return meets({x, 0.1f, 5}, {0, 0, -1}, 0, rays);
    }
};

} // namespace

TEST(DrawnPrims, TagsAndPathsChooseGeometry) {
    Mesh mesh;
    mesh.path = "/world/set/chair";
    RenderSettings settings;
    EXPECT_TRUE(isDrawn(mesh, settings));
    settings.renderTags = {"proxy"};
    EXPECT_FALSE(isDrawn(mesh, settings));
    settings.renderTags = {"geometry"};
    EXPECT_TRUE(isDrawn(mesh, settings));
    mesh.renderTag = "proxy";
    EXPECT_FALSE(isDrawn(mesh, settings));
    settings.renderTags.push_back("proxy");
    EXPECT_TRUE(isDrawn(mesh, settings));
    settings.rootPaths = {"/world/se"};
    EXPECT_FALSE(isDrawn(mesh, settings)) << "a prefix of a name holds nothing";
    settings.rootPaths = {"/other", "/world/set/"};
    EXPECT_TRUE(isDrawn(mesh, settings));
    settings.excludePaths = {"/world/set/chair/leg"};
    EXPECT_TRUE(isDrawn(mesh, settings));
    settings.excludePaths = {"/world/set/chair"};
    EXPECT_FALSE(isDrawn(mesh, settings));
    settings.rootPaths = {"/"};
    settings.excludePaths.clear();
    EXPECT_TRUE(isDrawn(mesh, settings));
}

TEST(DrawnPrims, ASceneChangesWithTheSettings) {
    Built built;
    auto left = makeQuad("/left"), right = makeQuad("/right");
    left->transform = translate(-2, 0, 0);
    left->renderTag = "guide";
    right->transform = translate(2, 0, 0);
    built.set(left, right, makeQuad("/protos/leaf", "P"),
              makeInstancer("/many", "", "P", {translate(6, 0, 0)}));
    EXPECT_TRUE(built.seen(-2) && built.seen(2) && built.seen(6));
    built.settings.renderTags = {"geometry"};
    built.update();
    EXPECT_FALSE(built.seen(-2));
    EXPECT_TRUE(built.seen(2) && built.seen(6));
    built.settings.rootPaths = {"/protos"};
    built.update();
    EXPECT_FALSE(built.seen(2));
    EXPECT_TRUE(built.seen(6));
    built.settings.rootPaths.clear();
    built.settings.excludePaths = {"/many"};
    built.update();
    EXPECT_TRUE(built.seen(2));
    EXPECT_FALSE(built.seen(6));
    built.settings = RenderSettings();
    built.update();
    EXPECT_TRUE(built.seen(-2) && built.seen(2) && built.seen(6));
}

TEST(DrawnPrims, IdsOfTheHost) {
    Built built;
    auto quad = makeQuad("/b");
    quad->id = 42;
    built.set(quad, makeQuad("/c", "", vec2(4, 0)));
    ASSERT_TRUE(built.seen(0));
    EXPECT_EQ(built.hit.surface->primId, 42);
    ASSERT_TRUE(built.seen(4));
    EXPECT_EQ(built.hit.surface->primId, 1) << "without an id the rank of the path";
}

TEST(DrawnPrims, IdCountsJoinTheLevelsOfNesting) {
    for (const bool counts : {false, true}) {
        Built built;
        auto inner = makeInstancer("/i1", "B", "A",
                                   {translate(0, 0, 0), translate(3, 0, 0), translate(6, 0, 0)});
        auto outer = makeInstancer("/i2", "", "B", {translate(0, 0, 0), translate(20, 0, 0)});
        outer->ids = {5, 7};
        if (counts) {
            inner->idCounts = {3};
            outer->idCounts = {2};
        }
        built.set(makeQuad("/leaf", "A"), inner, outer);
        ASSERT_TRUE(built.seen(26));
        EXPECT_EQ(built.hit.instanceId, counts ? 7 * 3 + 2 : 2);
        ASSERT_TRUE(built.seen(3));
        EXPECT_EQ(built.hit.instanceId, counts ? 5 * 3 + 1 : 1);
    }
}

TEST(DrawnPrims, InstancerVisibilityHoldsAtEveryLevel) {
    for (const bool nested : {false, true}) {
        Built built;
        auto outer = makeInstancer("/i2", "", nested ? "B" : "A", {mat4(1.0f)});
        outer->visibility.camera = false;
        built.set(makeQuad("/leaf", "A"), makeInstancer("/i1", "B", "A", {mat4(1.0f)}), outer);
        EXPECT_FALSE(built.seen(0));
        EXPECT_TRUE(built.seen(0, RayShadow));
        auto hidden = std::make_shared<Instancer>(*outer);
        hidden->visibility = Visibility::all(false);
        built.set(hidden);
        EXPECT_FALSE(built.seen(0, RayShadow));
        EXPECT_TRUE(built.embree.places().transforms("A").empty()) << "nor does it glow";
    }
}

TEST(DrawnPrims, InstancesWithoutAnInverseAreSkipped) {
    for (const bool nested : {false, true}) {
        Built built;
        mat4 nan(1.0f), far(1.0f);
        nan[3][0] = NAN;
        far[3][1] = INFINITY;
        built.set(makeQuad("/leaf", "A"), makeInstancer("/i1", "B", "A", {mat4(1.0f)}),
                  makeInstancer("/i2", "", nested ? "B" : "A",
                                {mat4(0.0f), nan, far, glm::scale(mat4(1.0f), vec3(1, 1, 0)),
                                 translate(4, 0, 0)}));
        EXPECT_FALSE(built.seen(0));
        ASSERT_TRUE(built.seen(4));
        EXPECT_EQ(built.hit.instanceId, nested ? 0 : 4) << "the innermost";
        EXPECT_GE(built.scene.diagnostics().count(), 1);
    }
}

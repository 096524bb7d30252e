// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/tests/builtScene.h"

using namespace patina;
using namespace patina::test;

TEST(EmbreeScene, HitOfAPrimInTheWorld) {
    BuiltScene built;
    auto quad = makeQuad("/quad");
    quad->transform = translate(0, 0, -5);
    built.set(quad);
    const vec3 origin(0.25f, 0.5f, 0), direction(0, 0, -1);
    ASSERT_TRUE(built.meets(origin));
    EXPECT_NEAR(built.hit.distance, 5.0f, 1e-5f);
    SurfacePoint point;
    computeSurfacePoint(built.hit, origin, direction, 0, point);
    EXPECT_NEAR(point.shading.geometricNormal.z, 1.0f, 1e-6f);
    EXPECT_NEAR(point.shading.objectPosition.z, 0.0f, 1e-5f);
    EXPECT_EQ(built.hit.instanceId, -1);
    EXPECT_FALSE(built.meets({1.5f, 0, 0}));
}

TEST(EmbreeScene, MirroringTransformKeepsTheFrontSide) {
    BuiltScene built;
    auto quad = makeQuad("/quad");
    quad->transform = glm::scale(mat4(1.0f), vec3(-1, 1, 1));
    built.set(quad);
    ASSERT_TRUE(built.meets({0, 0.1f, 3}));
    SurfacePoint point;
    computeSurfacePoint(built.hit, {0, 0.1f, 3}, {0, 0, -1}, 0, point);
    EXPECT_NEAR(point.shading.geometricNormal.z, 1.0f, 1e-6f);
}

TEST(EmbreeScene, InstancesOfThreeLevelsLandWhereTheirTransformsSay) {
    BuiltScene built;
    built.set(makeQuad("/leaf", "A"),
              makeInstancer("/i1", "B", "A", {translate(10, 0, 0), translate(20, 0, 0)}),
              makeInstancer("/i2", "C", "B", {translate(0, 100, 0), scaled(2.0f)}),
              makeInstancer("/i3", "", "C", {translate(0, 0, -7), translate(1000, 0, 0)}));
    const Hit& hit = built.hit;
    ASSERT_TRUE(built.meets({20.5f, 100.25f, 0}));
    EXPECT_NEAR(hit.distance, 7.0f, 1e-4f);
    EXPECT_EQ(hit.surface->prim->path, "/leaf");
    EXPECT_NEAR(hit.groupToWorld[3].x, 20.0f, 1e-4f);
    EXPECT_NEAR(hit.groupToWorld[3].y, 100.0f, 1e-4f);
    EXPECT_EQ(hit.instanceId, 1);
    // The scaled copy reaches from 18 to 22 around x = 20.
    ASSERT_TRUE(built.meets({1021.5f, 1.5f, 3}));
    EXPECT_NEAR(hit.distance, 3.0f, 1e-4f);
    EXPECT_FALSE(built.meets({1023.0f, 1.5f, 3}));
    EXPECT_TRUE(built.embree.occluded({1021.5f, 1.5f, 3}, {0, 0, -1}, 0, 10, 0, RayShadow));
    EXPECT_FALSE(built.embree.occluded({1023.0f, 1.5f, 3}, {0, 0, -1}, 0, 10, 0, RayShadow));
    EXPECT_EQ(built.embree.places().transforms("A").size(), 8u);
}

TEST(EmbreeScene, ANearerPlainHitIsNotMistakenForAnInstance) {
    BuiltScene built;
    auto front = makeQuad("/front");
    front->transform = translate(0, 0, -2);
    built.set(front, makeQuad("/leaf", "A"), makeInstancer("/i1", "B", "A", {mat4(1.0f)}),
              makeInstancer("/i2", "", "B", {translate(0, 0, -4)}));
    ASSERT_TRUE(built.meets({0, 0, 0}));
    EXPECT_EQ(built.hit.surface->prim->path, "/front");
    EXPECT_FALSE(built.hit.instanced);
}

TEST(EmbreeScene, CyclesOfInstancersAreReportedAndLeftOut) {
    BuiltScene built;
    built.set(makeQuad("/leaf", "A"), makeInstancer("/i1", "A", "A", {mat4(1.0f)}),
              makeInstancer("/i2", "", "A", {mat4(1.0f)}));
    EXPECT_GE(built.scene.diagnostics().count(), 1);
    EXPECT_TRUE(built.meets({0, 0, 1}));
}

TEST(EmbreeScene, SingularInstanceIsReportedAndLeftOut) {
    BuiltScene built;
    built.set(makeQuad("/leaf", "A"),
              makeInstancer("/i", "", "A", {mat4(0.0f), translate(0, 0, -1)}));
    ASSERT_TRUE(built.meets({0, 0, 0}));
    EXPECT_EQ(built.hit.instanceId, 1);
    EXPECT_EQ(built.scene.diagnostics().count(), 1);
}

TEST(EmbreeScene, MotionOfTransformAndInstance) {
    BuiltScene built;
    built.camera.shutterOpen = 0.0;
    built.camera.shutterClose = 1.0;
    MotionTransform motion;
    motion.times = {0.0f, 1.0f};
    motion.values = {mat4(1.0f), translate(4, 0, 0)};
    auto moving = makeQuad("/moving");
    moving->transform = motion;
    auto instancer = makeInstancer("/i", "", "A", {mat4(1.0f)});
    MotionTransform far = motion;
    for (dmat4& m : far.values)
        m = dmat4(translate(0, 50, 0)) * m;
    instancer->transforms[0] = far;
    built.set(moving, makeQuad("/leaf", "A"), instancer);
    for (float y : {0.0f, 50.0f}) {
        EXPECT_TRUE(built.meets({0, y, 1}, {0, 0, -1}, 0.0f));
        EXPECT_FALSE(built.meets({2, y, 1}, {0, 0, -1}, 0.0f));
        EXPECT_TRUE(built.meets({2, y, 1}, {0, 0, -1}, 0.5f));
        EXPECT_FALSE(built.meets({0, y, 1}, {0, 0, -1}, 0.75f));
    }
}

TEST(EmbreeScene, UnchangedPrimsKeepTheirSurfaces) {
    BuiltScene built;
    built.set(makeQuad("/a"), makeQuad("/b"));
    const auto a = built.embree.surfaces().find("/a");
    const auto b = built.embree.surfaces().find("/b");
    built.set(makeQuad("/b"));
    EXPECT_EQ(built.embree.surfaces().find("/b"), b) << "another object of equal contents";
    auto changed = makeQuad("/b");
    changed->points.values[0][0].x = -2;
    built.set(changed);
    EXPECT_EQ(built.embree.surfaces().find("/a"), a);
    EXPECT_NE(built.embree.surfaces().find("/b"), b);
}

TEST(EmbreeScene, VisibilityMasksRays) {
    BuiltScene built;
    auto quad = makeQuad("/quad");
    quad->visibility = {false, true, true};
    built.set(quad);
    EXPECT_FALSE(built.meets({0, 0, 1}));
    EXPECT_TRUE(built.meets({0, 0, 1}, {0, 0, -1}, 0, RayIndirect));
}

TEST(EmbreeScene, PacketsMeetWhatEachOfTheirRaysMeets) {
    for (const bool nested : {false, true}) {
        BuiltScene built;
        built.set(makeQuad("/wall"), makeQuad("/leaf", "A"),
                  makeInstancer("/i1", nested ? "B" : "", "A",
                                {translate(4, 0, 0), translate(8, 0, -1)}));
        if (nested)
            built.set(makeInstancer("/i2", "", "B", {translate(0, 0.3f, 0), translate(12, 0, 0)}));
        const vec3 origin(4, 0.1f, 3);
        for (const int count : {1, 7, EmbreeScene::packet}) {
            vec3 directions[EmbreeScene::packet];
            for (int i = 0; i < count; ++i)
                directions[i] = glm::normalize(vec3(-1.9f + 0.31f * float(i), 0.0f, -1.0f));
            if (count > 3) directions[3] = vec3(NAN);
            const unsigned blocked =
                built.embree.occludedRays(origin, directions, count, 0.0f, RayShadow);
            unsigned wanted = 0;
            for (int i = 0; i < count; ++i)
                if (built.embree.occluded(origin, directions[i], 0, INFINITY, 0, RayShadow))
                    wanted |= 1u << i;
            EXPECT_EQ(blocked, wanted) << "nested " << nested << ", " << count << " rays";
            if (count == EmbreeScene::packet) {
                EXPECT_NE(wanted, 0u);
                EXPECT_NE(wanted, 0xffffu) << "some pass";
            }
        }
    }
}

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/tests/builtScene.h"

using namespace patina;
using namespace patina::test;

namespace {

constexpr size_t trianglesOfSphere = 2 * 128 * 63; // 64 rings of 128 cells, those at the poles half

mat4 placeOf(int i) {
    const mat4 moved = translate(float(i) - 10.0f, 0.1f * float(i % 3), -6);
    const mat4 turned = glm::rotate(moved, 0.3f * float(i), glm::normalize(vec3(1, 2, 3)));
    return glm::scale(turned, vec3(1.0f, i % 4 == 3 ? -0.8f : 0.8f, 1.1f));
}

std::shared_ptr<Implicit> shapeOf(int i, ImplicitShape shape, bool shrinks) {
    auto prim = makePrim<Implicit>("/prim" + std::to_string(100 + i), placeOf(i));
    prim->shape = shape;
    const bool scales = shape == ImplicitShape::Sphere || shape == ImplicitShape::Cube;
    prim->radius = scales ? 0.3f + 0.01f * float(i) : 0.4f;
    prim->size = scales ? 0.5f + 0.01f * float(i) : 0.6f;
    prim->height = 0.7f;
    prim->leftHanded = i % 2 == 1;
    prim->primvars = {
        makePrimvar("displayColor", Interpolation::Constant, 3, {0.1f * float(i), 0.5f, 0.2f})};
    // What shrinks to a thousandth while the shutter is open is drawn alone.
    if (shrinks) {
        prim->transform.times.push_back(1.0f);
        prim->transform.values.push_back(prim->transform.first() *
                                         glm::scale(dmat4(1.0), dvec3(0.05)));
    }
    return prim;
}

void fill(BuiltScene& built, ImplicitShape shape, bool shrinks) {
    SceneEdit edit = built.scene.edit();
    for (int i = 0; i < 40; ++i)
        edit.set(shapeOf(i, shape, shrinks));
    edit.commit();
    built.update();
}

void expectNear(const vec3& a, const vec3& b, float tolerance, const char* what) {
    EXPECT_LT(glm::length(a - b), tolerance) << what;
}

} // namespace

TEST(SharedShapes, HitsAreThoseOfPrimsThatAreDrawnAlone) {
    for (ImplicitShape shape : {ImplicitShape::Sphere, ImplicitShape::Cube, ImplicitShape::Cylinder,
                                ImplicitShape::Capsule}) {
        BuiltScene together, alone;
        fill(together, shape, false);
        fill(alone, shape, true);
        EXPECT_LT(together.embree.surfaces().triangles(), alone.embree.surfaces().triangles() / 10);
        int hits = 0;
        for (int i = 0; i < 200; ++i) {
            const vec3 origin(0.11f * float(i) - 10.5f, 0.02f * float(i % 7), 2.0f);
            const vec3 direction = glm::normalize(vec3(0.01f * float(i % 5), 0.01f, -1.0f));
            const bool found = together.meets(origin, direction);
            ASSERT_EQ(found, alone.meets(origin, direction));
            const Hit &a = together.hit, &b = alone.hit;
            if (!found) continue;
            ++hits;
            EXPECT_NEAR(a.distance, b.distance, 1e-4f);
            EXPECT_EQ(a.surface->prim->path, b.surface->prim->path);
            EXPECT_EQ(a.surface->primId, b.surface->primId);
            EXPECT_EQ(a.instanceId, -1);
            SurfacePoint p, q;
            computeSurfacePoint(a, origin, direction, 0.01f, p);
            computeSurfacePoint(b, origin, direction, 0.01f, q);
            expectNear(p.shading.position, q.shading.position, 1e-4f, "position");
            expectNear(p.shading.objectPosition, q.shading.objectPosition, 1e-4f, "in the object");
            expectNear(p.shading.normal, q.shading.normal, 2e-3f, "normal");
            expectNear(p.shading.geometricNormal, q.shading.geometricNormal, 2e-3f, "flat normal");
            expectNear(p.shading.tangent, q.shading.tangent, 5e-3f, "tangent");
            EXPECT_EQ(a.surface->element(a.primitive), b.surface->element(b.primitive));
            for (const char* name : {"st", "displayColor"}) {
                float x[4] = {0, 0, 0, 0}, y[4] = {0, 0, 0, 0};
                ASSERT_TRUE(readAttribute(*a.surface, a.surface->findAttribute(name), a.primitive,
                                          a.u, a.v, x));
                ASSERT_TRUE(readAttribute(*b.surface, b.surface->findAttribute(name), b.primitive,
                                          b.u, b.v, y));
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(x[c], y[c], 2e-3f) << name;
            }
        }
        EXPECT_GT(hits, 40);
        EXPECT_EQ(together.scene.diagnostics().count(), 0);
    }
}

TEST(SharedShapes, ThousandsOfSpheresAreTheTrianglesOfOne) {
    BuiltScene built;
    SceneEdit edit = built.scene.edit();
    constexpr int count = 3000;
    for (int i = 0; i < count; ++i) {
        auto prim = makePrim<Implicit>("/ball" + std::to_string(i),
                                       translate(0.1f * float(i % 50), 0.1f * float(i / 50), -8));
        prim->radius = 0.01f + 1e-5f * float(i);
        edit.set(prim);
    }
    edit.commit();
    built.update();
    EXPECT_LE(built.embree.surfaces().triangles(),
              4 * trianglesOfSphere); // one per fineness at most
    // Embree keeps less than 4 kB per instance; a sphere of its own takes more than 600 kB.
    EXPECT_LT(built.embree.bytes(), size_t(count) * 4096 + (8u << 20));
}

TEST(SharedShapes, ShapesAreAsFineAsTheirSizeOnScreen) {
    const auto stored = [](float away) {
        BuiltScene built;
        built.set(makePrim<Implicit>("/ball", translate(0, 0, -away)));
        return built.embree.surfaces().triangles();
    };
    EXPECT_EQ(stored(5.0f), trianglesOfSphere);
    EXPECT_EQ(stored(1e5f), 2u * 16u * 7u); // an eighth of the segments either way
    EXPECT_LE(stored(2000.0f), stored(500.0f));
}

TEST(SharedShapes, DistinctShapesAreAsCoarseAsPixelsAllow) {
    BuiltScene built;
    built.settings.width = built.settings.height = 16;
    const float pixel = CameraRays(built.camera, built.settings, dvec3(0.0)).pixelSpread();
    SceneEdit edit = built.scene.edit();
    constexpr int count = 1000;
    constexpr float away = 100.0f;
    for (int i = 0; i < count; ++i) {
        auto prim = makePrim<Implicit>("/pill" + std::to_string(i), translate(0, 0, -away));
        prim->shape = ImplicitShape::Capsule;
        prim->radius = away * pixel * (1.0f + 1e-3f * float(i)); // one to two pixels
        prim->height = 2.0f * prim->radius;
        edit.set(prim);
    }
    edit.commit();
    built.update();
    // 32 segments leave less than a hundredth of a pixel.
    EXPECT_LE(built.embree.surfaces().triangles(), size_t(count) * 2 * 32 * 17);
}

TEST(SharedShapes, PrimsThatMoveBetweenBothWaysOfBeingDrawn) {
    BuiltScene built;
    const auto hits = [&](int prims) {
        int found = 0;
        for (int i = 0; i < prims; ++i)
            found += built.meets({float(i) - 10.0f, 0.1f * float(i % 3), 2.0f});
        return found;
    };
    for (const int prims : {10, 20, 12, 30}) {
        SceneEdit edit = built.scene.edit();
        edit.clear();
        for (int i = 0; i < prims; ++i)
            edit.set(shapeOf(i, ImplicitShape::Sphere, false));
        edit.commit();
        built.update();
        EXPECT_EQ(hits(prims), prims);
    }
}

TEST(SharedShapes, FlatPrimsAreDrawnAlone) {
    BuiltScene built;
    SceneEdit edit = built.scene.edit();
    for (int i = 0; i < 20; ++i) {
        auto prim = shapeOf(i, ImplicitShape::Sphere, false);
        prim->transform = glm::scale(mat4(1.0f), vec3(1, 1, 0));
        edit.set(prim);
    }
    edit.commit();
    built.update();
    EXPECT_TRUE(built.meets({0.01f, 0.02f, 3}));
    EXPECT_FALSE(built.hit.instanced);
}

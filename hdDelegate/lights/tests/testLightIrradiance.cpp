// SPDX-License-Identifier: Apache-2.0
// Each light type against the closed form of the irradiance that it gives, by samples and by rays.

#include "hdDelegate/lights/tests/lightTools.h"

using namespace patina;

namespace {

const vec3 up(0.0f, 1.0f, 0.0f);

/// Places a light so that its -z axis points down at the origin.
mat4 above(float height) {
    return at(0.0f, height, 0.0f) * turned(-testPi / 2.0, vec3(1.0f, 0.0f, 0.0f));
}

void expectIrradiance(const LightSet& set, const vec3& point, const vec3& normal, double exact,
                      bool hittable = true) {
    EXPECT_TRUE(agree(irradiance(set, point, normal, 40000, 7), exact, 1e-5));
    if (hittable) {
        EXPECT_TRUE(agree(irradianceByRays(set, point, normal, 400000, 8), exact, 1e-5)) << "rays";
    }
}

/// At the origin, from above.
void expectIrradiance(const std::shared_ptr<Light>& light, double exact, bool hittable = true) {
    LightScene scene;
    expectIrradiance(scene.build(light), vec3(0.0f), up, exact, hittable);
}

std::shared_ptr<Light> makeRound(LightType type, const mat4& transform, float radius,
                                 float intensity = 1.0f) {
    auto light = makeLight(type, transform);
    light->radius = radius;
    light->intensity = intensity;
    return light;
}

/// The corners of a rect light.
std::vector<vec3> corners(const Light& light, const mat4& m) {
    const float w = 0.5f * light.width, h = 0.5f * light.height;
    std::vector<vec3> result;
    for (const vec2 c : {vec2(-w, -h), vec2(w, -h), vec2(w, h), vec2(-w, h)})
        result.push_back(vec3(m * vec4(c.x, c.y, 0.0f, 1.0f)));
    return result;
}

/// Irradiance at the origin from the outside of a round shape of radiance 1, by summing over its
/// surface. @param cylinder instead of sphere
double roundIrradiance(const mat4& m, bool cylinder) {
    const glm::dvec3 point(0.0), normal(up);
    const glm::dmat3 a((mat3(m)));
    const glm::dmat3 cofactor = glm::determinant(a) * glm::transpose(glm::inverse(a));
    const int rows = 800, columns = 800;
    double sum = 0.0;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k) {
            const double t = (i + 0.5) / rows - 0.5, phi = 2.0 * testPi * (k + 0.5) / columns;
            const double s = cylinder ? 1.0 : std::sqrt(1.0 - 4.0 * t * t);
            const glm::dvec3 n(cylinder ? 0.0 : 2.0 * t, s * std::cos(phi), s * std::sin(phi));
            const glm::dvec3 q(cylinder ? t : 2.0 * t, n.y, n.z);
            const glm::dvec3 dA = cofactor * n; // times the unit shape's area element
            const glm::dvec3 v = point - (a * q + glm::dvec3(vec3(m[3])));
            const double d2 = glm::dot(v, v), leaving = glm::dot(v, dA),
                         arriving = -glm::dot(v, normal);
            if (leaving > 0.0 && arriving > 0.0) sum += leaving * arriving / (d2 * d2);
        }
    return sum / (rows * columns) * (cylinder ? 2.0 : 4.0) * testPi;
}

} // namespace

TEST(Irradiance, sphere) {
    const double d2 = 1.0 + 9.0 + 0.25;
    expectIrradiance(makeRound(LightType::Sphere, at(1.0f, 3.0f, 0.5f), 0.8f, 2.5f),
                     testPi * 2.5 * 0.64 / d2 * (3.0 / std::sqrt(d2)));
}

TEST(Irradiance, sphereAlmostTouching) {
    expectIrradiance(makeRound(LightType::Sphere, at(0.0f, 1.001f, 0.0f), 1.0f),
                     testPi / (1.001 * 1.001));
}

TEST(Irradiance, farSphereKeepsItsPrecision) {
    expectIrradiance(makeRound(LightType::Sphere, at(0.0f, 1e5f, 0.0f), 1.0f, 1e10f), testPi,
                     false);
}

TEST(Irradiance, ellipsoid) {
    mat4 m = glm::scale(at(0.4f, 2.5f, 0.3f) * turned(0.7, vec3(1.0f, 2.0f, 0.5f)),
                        vec3(1.5f, 0.3f, 0.8f));
    m[1] += 0.3f * m[0]; // and sheared
    expectIrradiance(makeRound(LightType::Sphere, m, 1.0f), roundIrradiance(m, false));
}

TEST(Irradiance, coaxialDisk) {
    expectIrradiance(makeRound(LightType::Disk, above(1.5f), 2.0f), testPi * 4.0 / (4.0 + 2.25));
}

TEST(Irradiance, rectByLambert) {
    for (const vec3 point : {vec3(0.0f), vec3(1.8f, 0.3f, -0.7f), vec3(0.5f, 0.99f, 0.2f)}) {
        auto light = makeLight(LightType::Rect, above(1.0f));
        light->width = 3.0f;
        light->height = 2.0f;
        LightScene scene;
        // The tilt would cut the horizon close below.
        const vec3 normal = point.y > 0.9f ? up : glm::normalize(vec3(0.02f, 1.0f, 0.0f));
        expectIrradiance(scene.build(light), point, normal,
                         polygonIrradiance(corners(*light, above(1.0f)), point, normal));
    }
}

TEST(Irradiance, distantRectAndParallelogram) {
    mat4 sheared = above(2.0f);
    sheared[0] += 0.7f * sheared[1];
    for (const mat4& m :
         {above(30.0f), sheared, glm::scale(above(3.0f), vec3(-1.0f, 2.0f, 1.0f))}) {
        auto light = makeLight(LightType::Rect, m);
        LightScene scene;
        const vec3 point(0.3f, 0.0f, 0.1f);
        expectIrradiance(scene.build(light), point, up,
                         polygonIrradiance(corners(*light, m), point, up), m[3].y < 10.0f);
    }
}

TEST(Irradiance, planarLightsShineOneWayOnly) {
    for (const LightType type : {LightType::Rect, LightType::Disk})
        for (const vec3 scale : {vec3(1.0f), vec3(-1.0f, 1.0f, 1.0f), vec3(1.0f, 1.0f, -1.0f)}) {
            LightScene scene;
            const LightSet& set = scene.build(makeLight(type, glm::scale(above(1.0f), scale)));
            // Local -z points down, and up where z is mirrored.
            const bool down = scale.z > 0.0f;
            EXPECT_EQ(irradiance(set, vec3(0.0f), up, 1000, 1).mean() > 0.0, down);
            EXPECT_EQ(irradiance(set, vec3(0.0f, 2.0f, 0.0f), -up, 1000, 1).mean() > 0.0, !down);
            EXPECT_EQ(irradianceByRays(set, vec3(0.0f), up, 1000, 1).mean() > 0.0, down);
        }
}

TEST(Irradiance, cylinder) {
    const mat4 m = at(0.2f, 1.6f, -0.4f) * turned(0.4, vec3(0.3f, 1.0f, 0.5f));
    for (const vec3 scale : {vec3(1.0f), vec3(1.0f, 2.0f, 0.5f)}) {
        auto light = makeRound(LightType::Cylinder, glm::scale(m, scale), 0.35f);
        light->length = 3.0f;
        expectIrradiance(
            light,
            roundIrradiance(glm::scale(glm::scale(m, scale), vec3(3.0f, 0.35f, 0.35f)), true));
    }
}

TEST(Irradiance, cylinderHasNoCaps) {
    auto light = makeLight(LightType::Cylinder);
    LightScene scene;
    const LightSet& set = scene.build(light);
    const vec3 beyond(3.0f, 0.0f, 0.0f);
    EXPECT_EQ(irradiance(set, beyond, vec3(-1.0f, 0.0f, 0.0f), 100, 1).mean(), 0.0);
    LightHit hit;
    EXPECT_EQ(set.intersect(beyond, vec3(-1.0f, 0.0f, 0.0f), 0.0f, 10.0f, 0.0f, &hit, 1), 0);
}

TEST(Irradiance, nothingInsideOfRoundLights) {
    for (const LightType type : {LightType::Sphere, LightType::Cylinder}) {
        LightScene scene;
        const LightSet& set = scene.build(makeLight(type));
        EXPECT_EQ(irradiance(set, vec3(0.1f), up, 1000, 1).mean(), 0.0);
        EXPECT_EQ(irradianceByRays(set, vec3(0.1f), up, 1000, 1).mean(), 0.0);
    }
}

TEST(Irradiance, distant) {
    for (const float angle : {0.53f, 20.0f}) {
        const float turn = 0.5f;
        auto light =
            makeLight(LightType::Distant, turned(-testPi / 2.0 + turn, vec3(1.0f, 0.0f, 0.0f)));
        light->angle = angle;
        light->intensity = 3.0f;
        const double s = std::sin(0.5 * angle * testPi / 180.0);
        expectIrradiance(light, 3.0 * testPi * s * s * std::cos(turn), angle > 1.0f);
    }
    auto light = makeLight(LightType::Distant, above(0.0f));
    light->angle = 0.0f;
    LightScene scene;
    LightSample s;
    ASSERT_TRUE(scene.build(light).sample(vec3(0.0f), up, false, vec3(0.5f), 0.0f, s));
    EXPECT_TRUE(s.delta);
    EXPECT_TRUE(std::isinf(s.distance));
    EXPECT_FLOAT_EQ(s.pdf, 1.0f);
    EXPECT_NEAR(s.direction.y, 1.0f, 1e-6f);
    EXPECT_FLOAT_EQ(s.radiance.x, 1.0f);
}

TEST(Irradiance, normalizedDistantDoesNotDependOnItsAngle) {
    for (const float angle : {0.0f, 0.5f, 30.0f, 180.0f}) {
        auto light = makeLight(LightType::Distant, above(0.0f));
        light->angle = angle;
        light->normalize = true;
        light->intensity = 4.0f;
        LightScene scene;
        EXPECT_TRUE(agree(irradiance(scene.build(light), vec3(0.0f), up, 20000, 3), 4.0, 1e-4))
            << angle;
    }
}

TEST(Irradiance, constantDome) {
    auto light = makeLight(LightType::Dome);
    light->exposure = 1.0f;
    expectIrradiance(light, 2.0 * testPi);
}

TEST(Irradiance, pointAndLineStandIns) {
    auto point = makeRound(LightType::Sphere, above(2.0f), 0.7f);
    point->treatAsPoint = true;
    expectIrradiance(point, testPi * 0.49 / 4.0, false);
    // Without a radius a normalized sphere keeps its power.
    point->treatAsPoint = false;
    point->radius = 0.0f;
    point->normalize = true;
    expectIrradiance(point, 0.25 / 4.0, false);

    auto line = makeRound(LightType::Cylinder, at(0.0f, 1.5f, 0.0f), 0.01f);
    line->length = 4.0f;
    line->treatAsLine = true;
    const double h = 1.5, x = 2.0;
    expectIrradiance(line, 0.02 * (std::atan(x / h) + h * x / (h * h + x * x)) / h, false);
}

TEST(Irradiance, trianglesByLambert) {
    LightScene scene;
    LightTriangle t = slantedTriangle();
    for (const float scale : {1.0f, 0.01f}) { // by solid angle, and by area
        LightTriangle s = t;
        const vec3 middle = (t.vertices[0] + t.vertices[1] + t.vertices[2]) / 3.0f;
        for (vec3& v : s.vertices)
            v = middle + scale * (v - middle);
        scene.setTriangles({s});
        const double exact =
            polygonIrradiance({s.vertices[0], s.vertices[1], s.vertices[2]}, vec3(0.0f), up);
        // (v1 - v0) x (v2 - v0) points down for this winding.
        expectIrradiance(scene.build(), vec3(0.0f), up, exact, false);
        EXPECT_EQ(irradiance(*scene.set, vec3(0.0f, 5.0f, 0.0f), -up, 100, 2).mean(), 0.0);
    }
}

TEST(Irradiance, movingLight) {
    auto light = makeLight(LightType::Sphere);
    light->transform.times = {0.0f, 1.0f};
    light->transform.values = {at(0.0f, 2.0f, 0.0f), at(0.0f, 6.0f, 0.0f)};
    LightScene scene;
    scene.input.shutterClose = 1.0f;
    const LightSet& set = scene.build(light);
    for (const float time : {0.0f, 0.5f, 1.0f}) {
        const double d = 2.0 + 4.0 * time;
        EXPECT_TRUE(
            agree(irradiance(set, vec3(0.0f), up, 20000, 5, time), testPi * 0.25 / (d * d), 1e-4));
    }
    LightHit hit;
    ASSERT_EQ(set.intersect(vec3(0.0f), up, 0.0f, 100.0f, 0.5f, &hit, 1), 1);
    EXPECT_NEAR(hit.distance, 3.5f, 1e-4f);
}

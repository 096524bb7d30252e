// SPDX-License-Identifier: Apache-2.0
// Choosing among many lights.

#include "hdDelegate/lights/tests/lightTools.h"

using namespace patina;

namespace {

const vec3 up(0.0f, 1.0f, 0.0f);

/// Lights of all kinds in a slab above the plane y = 0, wholly above it.
void scatter(LightScene& scene, int count, uint32_t seed) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const vec3 p(100.0f * random() - 50.0f, 1.0f + 8.0f * random(), 100.0f * random() - 50.0f);
        auto light = makeLight(LightType::Sphere, glm::translate(mat4(1.0f), p));
        light->radius = 0.05f + 0.2f * random();
        light->intensity = std::exp2(6.0f * random());
        light->treatAsPoint = i % 3 == 0;
        scene.add(light);
    }
}

double exactIrradiance(const Light& light, const vec3& point) {
    const glm::dvec3 v = glm::dvec3(vec3(light.transform.first()[3]) - point);
    const double d = glm::length(v);
    return testPi * light.intensity * light.radius * light.radius * v.y / (d * d * d);
}

double exactIrradiance(const LightScene& scene, const vec3& point) {
    double sum = 0.0;
    for (const LightInstance& instance : scene.input.lights)
        sum += exactIrradiance(*instance.light, point);
    return sum;
}

} // namespace

TEST(LightTree, probabilitiesSumToOne) {
    LightScene scene;
    scatter(scene, 500, 21);
    scene.add(makeLight(LightType::Dome));
    scene.add(makeLight(LightType::Distant));
    const LightSet& set = scene.build();
    for (const vec3 point : {vec3(0.0f), vec3(30.0f, 4.0f, -20.0f), vec3(500.0f, 0.0f, 0.0f)}) {
        double sum = 0.0;
        for (int i = 0; i < set.lightCount(); ++i)
            sum += set.selectionProbability(i, point, vec3(0.0f), true);
        EXPECT_NEAR(sum, 1.0, 1e-4);
    }
}

TEST(LightTree, choosesWithTheProbabilityThatItTells) {
    LightScene scene;
    scatter(scene, 60, 22);
    const LightSet& set = scene.build();
    const vec3 point(3.0f, 0.0f, 2.0f);
    std::vector<int> chosen(scene.input.lights.size(), 0);
    Random random(23);
    constexpr int draws = 200000;
    for (int i = 0; i < draws; ++i) {
        LightSample s;
        if (set.sample(point, up, false, random.cube(), 0.0f, s)) ++chosen[s.light];
    }
    for (size_t i = 0; i < chosen.size(); ++i) {
        const double p = set.selectionProbability(int(i), point, up, false);
        const double error = std::sqrt(p * (1.0 - p) / draws);
        EXPECT_NEAR(double(chosen[i]) / draws, p, test::sigmas * error + 1e-5) << i;
    }
}

namespace {

/// A bent patch of triangles of many brightnesses, some one-sided, at places of every kind.
void placePatches(LightScene& scene, bool shared, float mirror) {
    auto triangles = std::make_shared<std::vector<LightTriangle>>();
    Random random(31);
    for (int i = 0; i < 40; ++i) {
        LightTriangle t;
        const vec3 middle = 2.0f * random.cube() - 1.0f;
        for (vec3& v : t.vertices)
            v = middle + 0.3f * random.direction();
        t.luminance = 0.1f + random.cube().x;
        t.twoSided = mirror < 0.0f || i % 3 == 0;
        triangles->push_back(t);
    }
    for (int i = 0; i < 12; ++i) {
        const vec3 axis = random.direction(), scale = 0.5f + random.cube();
        const mat4 place = glm::scale(at(3.0f * float(i % 4), 4.0f, float(i / 4)) * turned(i, axis),
                                      i % 2 ? vec3(mirror * scale.x, scale.x, scale.x)
                                            : vec3(mirror, 1.0f, 1.0f) * scale);
        LightTrianglePlace added{triangles, place, true};
        added.factor = scale.y;
        if (!shared) {
            auto placed = std::make_shared<std::vector<LightTriangle>>(*triangles);
            for (LightTriangle& t : *placed) {
                t.luminance *= added.factor;
                for (vec3& v : t.vertices)
                    v = vec3(place * vec4(v, 1.0f));
            }
            added = {placed};
        }
        scene.input.add(added);
    }
}

} // namespace

TEST(LightTree, placesShareTheTreeOfTheirTriangles) {
    for (const float mirror : {1.0f, -1.0f}) {
        LightScene shared, flat;
        placePatches(shared, true, mirror);
        placePatches(flat, false, mirror);
        const LightSet &a = shared.build(), &b = flat.build();
        for (const vec3 point : {vec3(0.0f), vec3(4.0f, 3.5f, 1.0f), vec3(40.0f, 0.0f, 9.0f)}) {
            double sum = 0.0;
            for (int i = 0; i < shared.input.triangleCount; ++i)
                sum += a.selectionProbability(i, point, vec3(0.0f), true);
            EXPECT_LT(sum, 1.0 + 1e-4);
            if (mirror < 0.0f) { // all shine to both sides
                EXPECT_GT(sum, 1.0 - 1e-4);
            }
            const Estimate one = irradiance(a, point, up, 10000, 32);
            const Estimate other = irradiance(b, point, up, 10000, 33);
            EXPECT_TRUE(agree(one, other));
            // Trees know about as much of the light as one that holds all triangles.
            EXPECT_LT(one.error(), 2.0 * other.error());
        }
        Random random(34);
        for (int i = 0; i < 2000; ++i) {
            LightSample s;
            if (!a.sample(vec3(0.0f), up, false, random.cube(), 0.0f, s)) continue;
            EXPECT_NEAR(a.pdfTriangle(s.triangle, vec3(0.0f), up, false, s.distance * s.direction) /
                            s.pdf,
                        1.0f, 1e-2f);
        }
    }
}

TEST(LightTree, thousandLightsWithoutBias) {
    LightScene scene;
    scatter(scene, 1000, 24);
    const LightSet& set = scene.build();
    for (const vec3 point : {vec3(0.0f), vec3(-30.0f, 0.0f, 12.0f), vec3(49.0f, 0.0f, 49.0f)})
        EXPECT_TRUE(
            agree(irradiance(set, point, up, 50000, 25), exactIrradiance(scene, point), 1e-4));
}

TEST(LightTree, tenThousandLightsAreStillTold) {
    LightScene scene;
    scatter(scene, 10000, 26);
    const vec3 point(5.0f, 0.0f, -7.0f);
    const double exact = exactIrradiance(scene, point);
    const Estimate e = irradiance(scene.build(), point, up, 50000, 27);
    EXPECT_TRUE(agree(e, exact, 1e-4));
    // An even choice has a relative deviation of more than 5 here; the tree's stays near 1.
    EXPECT_LT(e.deviation() / e.mean(), 2.0);
    double evenSquares = 0.0;
    for (const LightInstance& instance : scene.input.lights)
        evenSquares += std::pow(exactIrradiance(*instance.light, point), 2.0) *
                       double(scene.input.lights.size());
    EXPECT_GT(std::sqrt(evenSquares) / exact, 5.0);
}

TEST(LightTree, raysFindTheLightsThatAScanFinds) {
    LightScene scene;
    scatter(scene, 400, 28);
    const LightSet& set = scene.build();
    Random random(29);
    int total = 0;
    for (int i = 0; i < 2000; ++i) {
        const vec3 origin(60.0f * random() - 30.0f, 10.0f * random(), 60.0f * random() - 30.0f);
        const vec3 d = random.direction();
        int expected = 0;
        for (const LightInstance& instance : scene.input.lights) {
            const Light& light = *instance.light;
            const vec3 v = vec3(light.transform.first()[3]) - origin;
            const float along = glm::dot(v, d), off2 = glm::dot(v, v) - along * along;
            expected += !light.treatAsPoint && along > 0.0f && off2 < light.radius * light.radius &&
                        glm::dot(v, v) > light.radius * light.radius;
        }
        LightHit hits[64];
        const int found = set.intersect(origin, d, 0.0f, INFINITY, 0.0f, hits, 64);
        total += found;
        EXPECT_EQ(found, expected);
        if (found > 1) { // with less room the nearest are kept
            float nearest = INFINITY;
            for (int k = 0; k < found; ++k)
                nearest = std::min(nearest, hits[k].distance);
            LightHit one;
            EXPECT_EQ(set.intersect(origin, d, 0.0f, INFINITY, 0.0f, &one, 1), 1);
            EXPECT_FLOAT_EQ(one.distance, nearest);
        }
    }
    EXPECT_GT(total, 5);
}

TEST(LightTree, lightsThatAimElsewhereAreNotChosen) {
    LightScene scene;
    // Fifty rects aim up, one aims down at the origin.
    for (int i = 0; i < 51; ++i)
        scene.add(makeLight(LightType::Rect, at(2.0f * (i - 25), 100.0f, 0.0f) *
                                                 turned(i == 25 ? -testPi / 2.0 : testPi / 2.0,
                                                        vec3(1.0f, 0.0f, 0.0f))));
    const LightSet& set = scene.build();
    EXPECT_GT(set.selectionProbability(25, vec3(0.0f), up, false), 0.99f);
}

TEST(LightTree, surfacesBelowTheHorizonAreNotChosen) {
    LightScene scene;
    for (const float y : {-5.0f, 5.0f})
        scene.add(makeLight(LightType::Sphere, at(0.0f, y, 0.0f)));
    const LightSet& set = scene.build();
    EXPECT_EQ(set.selectionProbability(0, vec3(0.0f), up, false), 0.0f);
    EXPECT_NEAR(set.selectionProbability(1, vec3(0.0f), up, false), 1.0f, 1e-5f);
    EXPECT_NEAR(set.selectionProbability(0, vec3(0.0f), up, true), 0.5f, 1e-3f);
}

TEST(LightTree, coincidentLightsDoNotDeepenItWithoutEnd) {
    LightScene scene;
    for (int i = 0; i < 5000; ++i)
        scene.add(makeLight(LightType::Sphere));
    const LightSet& set = scene.build();
    EXPECT_NEAR(set.selectionProbability(17, vec3(9.0f), vec3(0.0f), true), 1.0f / 5000.0f, 1e-6f);
}

TEST(LightTree, unionOfConesHoldsBoth) {
    Random random(30);
    for (int i = 0; i < 2000; ++i) {
        const DirectionCone a{random.direction(), 2.0f * random() * random(), 0.5f};
        const DirectionCone b{random.direction(), 2.0f * random() * random(), 1.0f};
        const DirectionCone u = unite(a, b);
        EXPECT_EQ(u.reach, 1.0f);
        for (const DirectionCone& c : {a, b}) {
            const float off = std::acos(std::clamp(glm::dot(u.axis, c.axis), -1.0f, 1.0f));
            EXPECT_GE(u.spread + 1e-3f, std::min(off + c.spread, float(testPi)));
        }
    }
}

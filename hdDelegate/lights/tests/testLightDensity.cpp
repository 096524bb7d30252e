// SPDX-License-Identifier: Apache-2.0
// Densities: what sample() reports, what the pdf functions say of the same direction, and that they
// integrate to 1.

#include "hdDelegate/lights/tests/lightTools.h"
#include "shaders/tests/pearson.h"

using namespace patina;

namespace {

mat4 place(const vec3& scale, float shear) {
    mat4 m = glm::scale(at(0.3f, 0.2f, -1.6f) * turned(2.6, vec3(0.2f, 1.0f, 0.1f)), scale);
    m[0] += shear * m[1];
    return m;
}

std::vector<std::shared_ptr<Light>> areaLights() {
    std::vector<std::shared_ptr<Light>> lights;
    for (const LightType type : areaTypes)
        for (const mat4& m : {place(vec3(1.0f), 0.0f), place(vec3(1.5f, 0.6f, 1.0f), 0.4f)})
            lights.push_back(makeLight(type, m));
    return lights;
}

} // namespace

TEST(Density, integratesToOne) {
    for (const auto& light : areaLights()) {
        LightScene scene;
        const LightSet& set = scene.build(light);
        Random random(11);
        const Estimate e = estimate(400000, [&] {
            const vec3 d = random.direction();
            LightHit hit;
            if (!set.intersect(vec3(0.0f), d, 0.0f, INFINITY, 0.0f, &hit, 1)) return 0.0;
            return 4.0 * testPi * set.pdf(0, vec3(0.0f), vec3(0.0f), false, 0.0f, hit);
        });
        EXPECT_TRUE(agree(e, 1.0)) << int(light->type);
    }
}

TEST(Density, sampleAndHitAgree) {
    for (const auto& light : areaLights()) {
        LightScene scene;
        const LightSet& set = scene.build(light);
        Random random(12);
        int missed = 0, compared = 0;
        for (int i = 0; i < 5000; ++i) {
            LightSample s;
            if (!set.sample(vec3(0.0f), vec3(0.0f), false, random.cube(), 0.0f, s)) continue;
            ++compared;
            EXPECT_NEAR(glm::length(s.direction), 1.0f, 1e-5f);
            LightHit hit;
            if (!set.intersect(vec3(0.0f), s.direction, 0.0f, INFINITY, 0.0f, &hit, 1)) {
                ++missed; // at the silhouette
                continue;
            }
            const float pdf = set.pdf(0, vec3(0.0f), vec3(0.0f), false, 0.0f, hit);
            EXPECT_NEAR(hit.distance, s.distance, 2e-2f * s.distance);
            // Grazing points lose digits to the cosine.
            if (glm::dot(-s.direction, s.normal) > 0.05f) {
                EXPECT_NEAR(pdf / s.pdf, 1.0f, 1e-2f) << int(light->type);
                EXPECT_NEAR(hit.radiance.y, s.radiance.y, 1e-4f * s.radiance.y);
            }
        }
        EXPECT_GT(compared, 4900);
        EXPECT_LT(missed, 25);
    }
}

TEST(Density, samplesFollowIt) {
    // Pearson's chi-squared over bins of direction, significance 1e-5 per light, fixed seed.
    for (const auto& light : areaLights()) {
        LightScene scene;
        const LightSet& set = scene.build(light);
        constexpr int drawn = 100000;
        // The bins' pole is y: the lights stand at -z, and bins at a pole are long and thin.
        const test::DirectionBins bins{24, 48, -1.0};
        const auto expected = bins.integrals(40, [&](const vec3& d) {
            LightHit hit;
            if (!set.intersect(vec3(0.0f), vec3(d.y, d.z, d.x), 0.0f, INFINITY, 0.0f, &hit, 1))
                return 0.0;
            return drawn * double(set.pdf(0, vec3(0.0f), vec3(0.0f), false, 0.0f, hit));
        });
        std::vector<double> found(expected.size(), 0.0);
        Random random(13);
        for (int i = 0; i < drawn; ++i) {
            LightSample s;
            if (set.sample(vec3(0.0f), vec3(0.0f), false, random.cube(), 0.0f, s))
                found[bins.of(vec3(s.direction.z, s.direction.x, s.direction.y))] += 1.0;
        }
        // Bins at the silhouette are integrated poorly; they are pooled with the thin ones.
        const test::Pearson result = test::pearson(expected, found, 200.0);
        ASSERT_GT(result.cells(), 6);
        EXPECT_GT(result.tail(), 1e-5) << int(light->type) << " with " << result.cells();
    }
}

TEST(Density, lightsAtInfinity) {
    auto distant = makeLight(LightType::Distant);
    distant->angle = 40.0f;
    for (const bool twoSided : {false, true})
        for (const auto& light : {distant, makeLight(LightType::Dome)})
            for (const vec3 normal : {vec3(0.0f), vec3(0.0f, 0.6f, 0.8f)}) {
                LightScene scene;
                const LightSet& set = scene.build(light);
                Random random(14);
                const Estimate e = estimate(200000, [&] {
                    return 4.0 * testPi * pdfTowards(set, random.direction(), normal, twoSided);
                });
                EXPECT_TRUE(agree(e, 1.0, 1e-5));
                LightSample s;
                ASSERT_TRUE(set.sample(vec3(0.0f), normal, twoSided, random.cube(), 0.0f, s));
                EXPECT_NEAR(pdfTowards(set, s.direction, normal, twoSided) / s.pdf, 1.0f, 1e-4f);
                EXPECT_EQ(set.environment(0, set.place(0, s.direction, 0.0f), 0.0f), s.radiance);
            }
}

TEST(Density, triangles) {
    LightScene scene;
    LightTriangle t = slantedTriangle();
    t.twoSided = true;
    std::vector<LightTriangle> triangles = {t, t};
    for (vec3& v : triangles[1].vertices)
        v = 0.03f * v + vec3(1.0f, 2.0f, 0.0f);
    scene.setTriangles(triangles);
    const LightSet& set = scene.build();
    Random random(15);
    int seen[2] = {0, 0};
    for (int i = 0; i < 2000; ++i) {
        LightSample s;
        ASSERT_TRUE(set.sample(vec3(0.0f), vec3(0.0f), false, random.cube(), 0.0f, s));
        ASSERT_EQ(s.light, s.triangle);
        ++seen[s.triangle];
        const LightTriangle& hit = triangles[size_t(s.triangle)];
        const vec2 b = s.barycentrics;
        EXPECT_TRUE(b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0001f);
        const vec3 p =
            hit.vertices[0] * (1.0f - b.x - b.y) + hit.vertices[1] * b.x + hit.vertices[2] * b.y;
        EXPECT_LT(glm::length(p - s.distance * s.direction), 1e-4f);
        EXPECT_NEAR(set.pdfTriangle(s.triangle, vec3(0.0f), vec3(0.0f), false, p) / s.pdf, 1.0f,
                    2e-3f);
    }
    EXPECT_GT(seen[0], 100);
    EXPECT_GT(seen[1], 0);
}

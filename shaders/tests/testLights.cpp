// SPDX-License-Identifier: Apache-2.0
// Shapes, shaping and maps of lights: what the rasterizer and the page have of them is what
// geometry says; samples of sphere lights are in `SphereLight`. The path tracer's samples are
// tested in hdDelegate/lights/tests.

#include "shaders/lights.h"
#include "shaders/tests/estimate.h"

#include <vector>

using namespace patina;
using namespace patina::shLights;

namespace {

test::Random dice(7);

/// A skewed map; the third axis is the unit normal, as of flat shapes.
ShapeFrame skewed(bool flat) {
    mat3 axes(vec3(1.2f, 0.3f, 0.0f), vec3(-0.2f, 0.5f, 0.4f), vec3(0.1f, 0.3f, -0.8f));
    if (flat) axes[2] = glm::normalize(glm::cross(axes[0], axes[1]));
    return {vec3(0.4f, 0.2f, 2.0f), axes, glm::inverse(axes), std::fabs(glm::determinant(axes))};
}

/// A light under an affine map, seen from the origin.
struct Pose {
    vec3 origin;
    glm::mat3 axes;

    bool hit(const vec3& wi, float& t, float& density) const {
        const glm::mat3 inverse = glm::inverse(axes);
        return sphereLightHit(inverse * -origin, inverse * wi, std::fabs(glm::determinant(axes)), t,
                              density);
    }
    /// Towards a place of the light.
    vec3 sample(test::Random& random) const {
        return glm::normalize(origin + axes * sphereLightPlace(random.cube()));
    }
};

std::vector<Pose> poses() {
    const glm::mat3 round(0.5f),
        skewed(vec3(1.2f, 0.1f, 0.0f), vec3(-0.2f, 0.4f, 0.1f), vec3(0.0f, 0.3f, -0.7f));
    std::vector<Pose> all;
    for (const glm::mat3& axes : {round, skewed})
        for (const vec3& at :
             {vec3(1.6f, 1.2f, 0.1f), vec3(0.1f, -1.2f, 0.9f), vec3(-0.5f, 1.7f, -1.3f)})
            all.push_back({at, axes});
    return all;
}

bool isFlat(int kind) {
    return kind == SHAPE_RECT || kind == SHAPE_DISK;
}

} // namespace

// The solid angle is the mean of one over the density of places that face the point, and a share of
// all directions that hit.
TEST(Lights, placesHaveTheirDensity) {
    constexpr int count = 200000;
    for (int kind = 0; kind < SHAPES; ++kind) {
        const ShapeFrame s = skewed(isFlat(kind));
        const vec3 point = s.origin + 1.4f * s.axes[2] - 0.3f * s.axes[0] + 0.5f * s.axes[1];
        test::Mean byPlaces, met;
        for (int i = 0; i < count; ++i) {
            const vec3 q = shapePlace(kind, dice.square());
            const vec3 normal = shapeNormalAt(kind, s, q);
            const float byArea = shapePlaceDensity(kind, s, q);
            const float pdf = areaToSolidAngle(byArea, point - s.origin - s.axes * q, normal);
            byPlaces.add(pdf > 0.0f ? 1.0 / double(pdf) : 0.0);
            float t;
            vec3 on;
            const vec3 d = s.inverse * dice.direction();
            met.add(shapeHit(kind, shapeLocal(s, point), d, t, on) ? 4.0 * test::pi : 0.0);
        }
        ASSERT_GT(met.mean(), 0.1) << kind;
        EXPECT_TRUE(agree(byPlaces, met)) << kind;
    }
}

TEST(Lights, placesAreInTheBoxAround) {
    for (int kind = 0; kind < SHAPES; ++kind) {
        const ShapeFrame s = skewed(isFlat(kind));
        const vec3 extent = shapeExtent(kind, s);
        vec3 reach(0.0f);
        for (int i = 0; i < 20000; ++i)
            reach = glm::max(reach, abs(s.axes * shapePlace(kind, dice.square())));
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(reach[c], extent[c] * 1.00001f) << kind;
            EXPECT_GE(reach[c], extent[c] * 0.95f) << kind; // the box is no larger than it must be
        }
    }
}

TEST(Lights, raysToPlacesMeetThem) {
    for (int kind = 0; kind < SHAPES; ++kind) {
        const ShapeFrame s = skewed(isFlat(kind));
        const vec3 point = s.origin + 1.4f * s.axes[2];
        for (int i = 0; i < 1000; ++i) {
            const vec2 u = 0.98f * dice.square() + 0.01f; // the edges are rounding's
            const vec3 place = shapePlace(kind, u), normal = shapeNormalAt(kind, s, place);
            vec3 q;
            const vec3 d = s.origin + s.axes * place - point;
            const float l = glm::length(d);
            if (glm::dot(d, normal) > -0.02f * l) continue;
            float t = 0.0f;
            ASSERT_TRUE(shapeHit(kind, shapeLocal(s, point), s.inverse * (d / l), t, q)) << kind;
            EXPECT_NEAR(t, l, 1e-4f * l);
            EXPECT_LT(glm::length(q - place), 1e-3f);
        }
    }
}

TEST(Lights, nothingIsMetFromBehindOrInside) {
    float t;
    vec3 q;
    EXPECT_FALSE(rectHit(vec3(0, 0, -1), vec3(0, 0, 1), t, q));
    EXPECT_FALSE(diskHit(vec3(0, 0, 1), vec3(0, 0, 1), t, q));
    EXPECT_FALSE(sphereHit(vec3(0.5f, 0, 0), vec3(1, 0, 0), t, q));
    EXPECT_FALSE(sphereHit(vec3(2, 0, 0), vec3(1, 0, 0), t, q));
    EXPECT_FALSE(cylinderHit(vec3(0, 0.5f, 0), vec3(0, 1, 0), t, q));
    EXPECT_FALSE(cylinderHit(vec3(-2, 0.5f, 0), vec3(1, 0, 0), t, q)); // no caps
}

// A table that is linear in both angles is met everywhere, and its seam is closed.
TEST(Lights, tablesAreLinearBetweenDirections) {
    const int thetas = 7, phis = 5;
    const auto value = [&](float theta, float phi) { return vec3(theta, phi, theta * phi); };
    const auto at = [&](int i) {
        return value(float(i % thetas) / float(thetas - 1) * PI,
                     float(i / thetas) / float(phis - 1) * TWO_PI);
    };
    for (int i = 0; i < 1000; ++i) {
        const float theta = dice() * PI, phi = dice() * 0.999f * TWO_PI;
        const TableCell c = directionCell(thetas, phis, theta, phi - (i % 2 ? TWO_PI : 0.0f));
        ASSERT_GE(c.low, 0);
        ASSERT_LT(c.highNext, thetas * phis);
        const vec3 found = tableMix(c, at(c.low), at(c.lowNext), at(c.high), at(c.highNext));
        EXPECT_LT(glm::length(found - value(theta, phi)), 1e-4f);
    }
    for (const float phi : {-1e-9f, 0.0f, TWO_PI, -TWO_PI}) // rounding may make a whole turn of it
        EXPECT_LT(directionCell(thetas, phis, PI, phi).highNext, thetas * phis);
    EXPECT_LT(directionCell(thetas, 1, PI, 3.0f).highNext, thetas);
}

TEST(Lights, imagesOfRectsStandAsTheSchemaSays) {
    const TableCell corner = rectTexels(vec3(0.5f, 0.5f, 0.0f), 4, 3);
    EXPECT_EQ(corner.low, 0);
    EXPECT_EQ(corner.across, 0.0f);
    EXPECT_EQ(rectTexels(vec3(-0.5f, 0.5f, 0.0f), 4, 3).low, 3);
    EXPECT_EQ(rectTexels(vec3(0.5f, -0.5f, 0.0f), 4, 3).low, 8);
    const TableCell last = rectTexels(vec3(-0.5f, -0.5f, 0.0f), 4, 3);
    EXPECT_EQ(last.highNext, 11);
    EXPECT_EQ(rectTexels(vec3(0.3f, 0.2f, 0.0f), 1, 1).highNext, 0);
}

TEST(Lights, conesFadeFromStartToEnd) {
    EXPECT_EQ(shapingCone(0.1f, 0.2f, 0.4f), 1.0f);
    EXPECT_FLOAT_EQ(shapingCone(0.3f, 0.2f, 0.4f), 0.5f);
    EXPECT_EQ(shapingCone(0.5f, 0.2f, 0.4f), 0.0f);
    EXPECT_EQ(shapingCone(0.4f, 0.4f, 0.4f), 1.0f); // a sharp edge
    EXPECT_EQ(shapingCone(0.41f, 0.4f, 0.4f), 0.0f);
}

TEST(Lights, domesMapBothWays) {
    for (int i = 0; i < 1000; ++i) {
        const vec3 d = dice.direction();
        EXPECT_LT(glm::length(domeDirection(domeTexel(d)) - d), 1e-5f);
    }
    EXPECT_LT(glm::length(domeDirection(vec2(0.5f, 0.5f)) - vec3(0, 0, 1)), 1e-6f);
    EXPECT_LT(glm::length(domeDirection(vec2(0.75f, 0.5f)) - vec3(-1, 0, 0)), 1e-6f);
}

// Also of cones so narrow that their cosine is 1 in floats.
TEST(Lights, samplesOfDistantLightsAreInTheirCone) {
    for (const float versine : {2.0f, 0.5f, 1e-5f, 1e-9f})
        for (int i = 0; i < 1000; ++i) {
            const vec3 toLight = dice.direction();
            const vec2 u(0.99f * dice(), dice());
            EXPECT_TRUE(distantHit(toLight, versine * 1.001f + 1e-13f,
                                   distantSample(lightBasis(toLight), versine, u)))
                << versine;
        }
    EXPECT_FALSE(distantHit(vec3(0, 0, 1), 0.1f, vec3(1, 0, 0)));
}

// One over the density is the length of the line, in the mean.
TEST(Lights, linesAreSampledByTheirDensity) {
    const vec3 middle(0.2f, 1.0f, -0.4f), along(1.0f, 2.0f, -2.0f);
    for (const vec3 point : {vec3(0.0f), vec3(0.3f, 1.1f, 0.5f), vec3(3.0f, 8.0f, -5.0f)}) {
        const test::Mean e = test::estimate(20000, [&] {
            vec3 d;
            float pdf;
            EXPECT_TRUE(lineSample(middle, along, point, dice(), d, pdf));
            EXPECT_LT(glm::length(glm::cross(point + d - middle, along) / 3.0f), 1e-4f);
            return 1.0 / double(pdf);
        });
        EXPECT_NEAR(e.mean(), 3.0, 4.0 * e.error() + 1e-4);
    }
}

// The solid angle is a sum of one over density over samples, and a count over all directions.
TEST(SphereLight, samplesHaveTheirDensity) {
    test::Random random(11);
    constexpr int count = 200000, side = 1500;
    for (const Pose& p : poses()) {
        double bySamples = 0.0, lit = 0.0, turned = 0.0, turnedLit = 0.0;
        for (int i = 0; i < count; ++i) {
            const vec3 wi = p.sample(random);
            float t, density;
            if (!p.hit(wi, t, density)) continue;
            bySamples += 1.0 / density / count;
            turned += wi.y / density / count; // where they are, not only how many
        }
        for (int i = 0; i < side * side; ++i) {
            const float z = 1.0f - 2.0f * (float(i % side) + 0.5f) / float(side);
            const float r = std::sqrt(1.0f - z * z),
                        a = 2.0f * PI * (float(i / side) + 0.5f) / float(side);
            const vec3 wi(r * std::cos(a), r * std::sin(a), z);
            float t, density;
            if (!p.hit(wi, t, density)) continue;
            lit += 4.0 * PI / (double(side) * side);
            turnedLit += wi.y * 4.0 * PI / (double(side) * side);
        }
        ASSERT_GT(lit, 0.0);
        EXPECT_NEAR(bySamples / lit, 1.0, 0.01);
        EXPECT_NEAR(turned / lit, turnedLit / lit, 0.01);
    }
}

// From far away all samples of a ball count alike: that is what they are for.
TEST(SphereLight, densityIsEvenFromFarAway) {
    const Pose p{vec3(100.0f, 3.0f, 1.0f), glm::mat3(0.5f)};
    test::Random random(12);
    float low = 1e30f, high = 0.0f;
    for (int i = 0; i < 1000; ++i) {
        float t, density;
        if (!p.hit(p.sample(random), t, density)) continue;
        low = std::min(low, density);
        high = std::max(high, density);
    }
    EXPECT_LT(high / low, 1.02f);
}

TEST(SphereLight, nothingShinesInwards) {
    float t, density;
    EXPECT_FALSE(sphereLightHit(vec3(0.2f, 0.0f, 0.0f), vec3(1, 0, 0), 1.0f, t, density));
    EXPECT_FALSE(sphereLightHit(vec3(2.0f, 0.0f, 0.0f), vec3(1, 0, 0), 1.0f, t, density));
}

// A lamp of a centimetre, ten kilometres away.
TEST(SphereLight, smallOnesFarAwayAreNotLost) {
    const Pose p{vec3(8000.0f, 5000.0f, 3000.0f), glm::mat3(0.01f)};
    const float solidAngle = PI * 0.01f * 0.01f / glm::dot(p.origin, p.origin);
    test::Random random(13);
    for (int i = 0; i < 1000; ++i) {
        float t, density;
        p.hit(p.sample(random), t, density);
        ASSERT_NEAR(density * solidAngle, 1.0f, 0.001f);
    }
}

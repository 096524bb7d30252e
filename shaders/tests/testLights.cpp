// SPDX-License-Identifier: Apache-2.0
// Shapes, shaping and maps of lights: what the rasterizer and the page have of them is what
// geometry says. The path tracer's samples are tested in hdDelegate/lights/tests.

#include <cmath>
#include <random>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shaders/lights.h"

using namespace patina::shLights;

namespace {

std::mt19937 engine(7);

float number() {
    return std::uniform_real_distribution<float>(0.0f, 1.0f)(engine);
}
vec2 pair() {
    const float x = number();
    return vec2(x, number());
}
vec3 direction() {
    const float z = 1.0f - 2.0f * number(), a = 2.0f * PI * number();
    const float r = std::sqrt(1.0f - z * z);
    return vec3(r * std::cos(a), r * std::sin(a), z);
}

/// A skewed map; the third axis is the unit normal, as of flat shapes.
ShapeFrame skewed(bool flat) {
    mat3 axes(vec3(1.2f, 0.3f, 0.0f), vec3(-0.2f, 0.5f, 0.4f), vec3(0.1f, 0.3f, -0.8f));
    if (flat) axes[2] = glm::normalize(glm::cross(axes[0], axes[1]));
    return {vec3(0.4f, 0.2f, 2.0f), axes, glm::inverse(axes), std::fabs(glm::determinant(axes))};
}

bool isFlat(int kind) {
    return kind == SHAPE_RECT || kind == SHAPE_DISK;
}

} // namespace

// The solid angle is the mean of one over the density of places that face the point, and a share of
// all directions that hit. Four standard errors of both.
TEST(Lights, placesHaveTheirDensity) {
    constexpr int count = 200000;
    for (int kind = 0; kind < SHAPES; ++kind) {
        const ShapeFrame s = skewed(isFlat(kind));
        const vec3 point = s.origin + 1.4f * s.axes[2] - 0.3f * s.axes[0] + 0.5f * s.axes[1];
        double byPlaces = 0.0, squares = 0.0, met = 0.0;
        for (int i = 0; i < count; ++i) {
            const vec3 q = shapePlace(kind, pair());
            const vec3 normal = shapeNormalAt(kind, s, q);
            const float byArea = shapePlaceDensity(kind, s, q);
            const float pdf = areaToSolidAngle(byArea, point - s.origin - s.axes * q, normal);
            const double one = pdf > 0.0f ? 1.0 / double(pdf) : 0.0;
            byPlaces += one / count;
            squares += one * one / count;
            float t;
            vec3 on;
            met += shapeHit(kind, shapeLocal(s, point), s.inverse * direction(), t, on) ? 1.0 : 0.0;
        }
        const double all = 4.0 * 3.14159265358979, share = met / count;
        const double error = std::sqrt((squares - byPlaces * byPlaces) / count) +
                             all * std::sqrt(share * (1.0 - share) / count);
        ASSERT_GT(share, 0.01) << kind;
        EXPECT_NEAR(byPlaces, all * share, 4.0 * error) << kind;
    }
}

TEST(Lights, placesAreInTheBoxAround) {
    for (int kind = 0; kind < SHAPES; ++kind) {
        const ShapeFrame s = skewed(isFlat(kind));
        const vec3 extent = shapeExtent(kind, s);
        vec3 reach(0.0f);
        for (int i = 0; i < 20000; ++i)
            reach = glm::max(reach, abs(s.axes * shapePlace(kind, pair())));
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
            const vec2 u = 0.98f * pair() + 0.01f; // the edges are rounding's
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
        const float theta = number() * PI, phi = number() * 0.999f * TWO_PI;
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
        const vec3 d = direction();
        EXPECT_LT(glm::length(domeDirection(domeTexel(d)) - d), 1e-5f);
    }
    EXPECT_LT(glm::length(domeDirection(vec2(0.5f, 0.5f)) - vec3(0, 0, 1)), 1e-6f);
    EXPECT_LT(glm::length(domeDirection(vec2(0.75f, 0.5f)) - vec3(-1, 0, 0)), 1e-6f);
}

// Also of cones so narrow that their cosine is 1 in floats.
TEST(Lights, samplesOfDistantLightsAreInTheirCone) {
    for (const float versine : {2.0f, 0.5f, 1e-5f, 1e-9f})
        for (int i = 0; i < 1000; ++i) {
            const vec3 toLight = direction();
            const vec2 u(0.99f * number(), number());
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
        double sum = 0.0, squares = 0.0;
        constexpr int count = 20000;
        for (int i = 0; i < count; ++i) {
            vec3 d;
            float pdf;
            ASSERT_TRUE(lineSample(middle, along, point, number(), d, pdf));
            const vec3 off = glm::cross(point + d - middle, along) / 3.0f;
            ASSERT_LT(glm::length(off), 1e-4f);
            sum += 1.0 / double(pdf) / count;
            squares += 1.0 / double(pdf) / double(pdf) / count;
        }
        EXPECT_NEAR(sum, 3.0, 4.0 * std::sqrt((squares - sum * sum) / count) + 1e-4);
    }
}

// SPDX-License-Identifier: Apache-2.0
// Hermite and NURBS curves as Bezier ones.

#include "hdDelegate/geometry/curveForms.h"
#include "hdDelegate/geometry/curveSegments.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"

#include <gtest/gtest.h>

#include <limits>

namespace patina {
namespace {

template <class T> CurveSet drawn(const T& curves) {
    Diagnostics diagnostics;
    const auto bezier = toBezier(curves, diagnostics);
    expectSilence(diagnostics);
    EXPECT_EQ(bezier->basis, CurveBasis::Bezier);
    return build(*bezier);
}

/// Position and radius.
vec4 at(const CurveSet& set, size_t segment, float u, size_t step = 0) {
    const vec4 w = basisWeights(set.basis, u);
    vec4 sum(0.0f);
    for (int k = 0; k < 4; ++k)
        sum += w[k] * set.controlPoints[step][set.segments[segment] + uint32_t(k)];
    return sum;
}

HermiteCurves hermite() {
    HermiteCurves curves;
    curves.path = "/curves";
    curves.curveVertexCounts = {3, 2};
    curves.points = std::vector<vec3>{{0, 0, 0}, {1, 1, 0}, {2, 0, 1}, {0, 0, 5}, {1, 0, 5}};
    curves.tangents = std::vector<vec3>{{1, 2, 0}, {1, 0, 1}, {3, -1, 0}, {0, 2, 0}, {0, 0, 2}};
    curves.primvars = {makePrimvar("widths", Interpolation::Varying, 1, {2, 4, 8, 1, 1})};
    return curves;
}

TEST(HermiteCurves, areCubicsWithTheirTangents) {
    const HermiteCurves curves = hermite();
    const CurveSet set = drawn(curves);
    ASSERT_EQ(set.segments.size(), 3u);
    EXPECT_EQ(set.segmentCurve, (std::vector<int>{0, 0, 1}));
    const size_t firsts[] = {0, 1, 3};
    for (size_t s = 0; s < 3; ++s)
        for (float u : {0.0f, 0.25f, 0.5f, 0.9f, 1.0f}) {
            const vec3 a = curves.points.first()[firsts[s]],
                       b = curves.points.first()[firsts[s] + 1];
            const vec3 ta = curves.tangents.first()[firsts[s]],
                       tb = curves.tangents.first()[firsts[s] + 1];
            const float v = 1.0f - u;
            const vec3 truth =
                v * v * (1 + 2 * u) * a + u * v * v * ta + u * u * (1 + 2 * v) * b - u * u * v * tb;
            EXPECT_LT(glm::distance(vec3(at(set, s, u)), truth), 1e-6f) << s << " " << u;
        }
    EXPECT_NEAR(at(set, 0, 0.5f).w, 1.5f, 1e-6f); // radii are linear between points
    EXPECT_NEAR(at(set, 1, 0.25f).w, 2.5f, 1e-6f);
}

TEST(HermiteCurves, valuesPerPointAndPerCurve) {
    HermiteCurves curves = hermite();
    curves.primvars.push_back(makePrimvar("v", Interpolation::Vertex, 1, {0, 1, 2, 3, 4}));
    curves.primvars.push_back(makePrimvar("c", Interpolation::Uniform, 1, {10, 20}));
    const CurveSet set = drawn(curves);
    EXPECT_EQ(set.attribute("v")->data, (std::vector<float>{0, 1, 1, 2, 3, 4}));
    EXPECT_EQ(set.attribute("c")->data, (std::vector<float>{10, 20}));
}

TEST(HermiteCurves, tangentsThatDoNotFitAreReported) {
    HermiteCurves curves = hermite();
    curves.tangents.values[0].pop_back();
    Diagnostics diagnostics;
    const auto bezier = toBezier(curves, diagnostics);
    EXPECT_TRUE(warned(diagnostics, "/curves", "tangents"));
    EXPECT_EQ(build(*bezier).segments.size(), 3u);
}

TEST(HermiteCurves, shortCurvesAreLeftOutAndTheRestKeepsItsValues) {
    HermiteCurves curves = hermite();
    curves.curveVertexCounts = {1, 2, 2};
    curves.primvars.push_back(makePrimvar("c", Interpolation::Uniform, 1, {10, 20, 30}));
    curves.subsets = {{"/curves/s", "/m", {0, 2}}};
    Diagnostics diagnostics;
    const auto bezier = toBezier(curves, diagnostics);
    EXPECT_TRUE(warned(diagnostics, "/curves", "curveVertexCounts"));
    const CurveSet set = build(*bezier);
    EXPECT_EQ(set.segments.size(), 2u);
    EXPECT_EQ(set.attribute("c")->data, (std::vector<float>{20, 30}));
    EXPECT_EQ(set.segmentSubset, (std::vector<uint16_t>{0, 1}));
    EXPECT_NEAR(at(set, 0, 0.0f).w, 2.0f, 1e-6f);
}

TEST(HermiteCurves, countsOfAnySizeAreHarmless) {
    HermiteCurves curves = hermite();
    curves.curveVertexCounts = {1000000000, 1000000000, 1000000000, -5};
    Diagnostics diagnostics;
    EXPECT_TRUE(toBezier(curves, diagnostics)->curveVertexCounts.empty());
}

/// A cubic with a knot in the middle, and another one.
NurbsCurves cubic() {
    NurbsCurves curves;
    curves.path = "/curves";
    curves.curveVertexCounts = {5, 4};
    curves.orders = {4, 4};
    curves.knots = {0, 0, 0, 0, 1, 3, 3, 3, 3, 0, 1, 2, 3, 4, 5, 6, 7};
    curves.points = std::vector<vec3>{{0, 0, 0}, {1, 2, 0}, {2, 0, 1}, {3, 1, 0}, {4, 0, 0},
                                      {0, 0, 5}, {1, 0, 5}, {2, 3, 5}, {3, 0, 5}};
    curves.primvars = {makePrimvar("widths", Interpolation::Constant, 1, {0.5f})};
    return curves;
}

TEST(NurbsCurves, cubicsAreTheirBezierCurves) {
    const CurveSet set = drawn(cubic());
    ASSERT_EQ(set.segments.size(), 3u);
    // By Boehm's insertion of the knot 1 twice more, by hand.
    const vec3 p[] = {{0, 0, 0}, {1, 2, 0}, {2, 0, 1}, {3, 1, 0}, {4, 0, 0}};
    const float x = 1.0f / 3.0f;
    const vec3 a1 = p[1] * (1 - x) + p[2] * x, a2 = p[2] * (1 - x) + p[3] * x;
    const vec3 b = a1 * (1 - x) + a2 * x;
    const vec3 expected[] = {p[0], p[1], a1, b, a2, p[3], p[4]};
    for (int i = 0; i < 7; ++i)
        EXPECT_LT(glm::distance(vec3(set.controlPoints[0][size_t(i)]), expected[i]), 1e-6f) << i;
    // Uniform knots: a uniform B-spline segment.
    const vec3 q[] = {{0, 0, 5}, {1, 0, 5}, {2, 3, 5}, {3, 0, 5}};
    vec3 bezier[4];
    toBezier(CurveBasis::Bspline, q, bezier);
    for (int k = 0; k < 4; ++k)
        EXPECT_LT(glm::distance(vec3(set.controlPoints[0][size_t(7 + k)]), bezier[k]), 1e-6f) << k;
}

TEST(NurbsCurves, rationalCircleIsRound) {
    NurbsCurves curves;
    curves.path = "/curves";
    const double w = std::sqrt(0.5);
    curves.points = std::vector<vec3>{{1, 0, 0},   {1, 1, 0},  {0, 1, 0},  {-1, 1, 0}, {-1, 0, 0},
                                      {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {1, 0, 0}};
    curves.weights = {1, w, 1, w, 1, w, 1, w, 1};
    curves.curveVertexCounts = {9};
    curves.orders = {3};
    curves.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    curves.primvars = {makePrimvar("widths", Interpolation::Constant, 1, {0.1f})};
    const CurveSet set = drawn(curves);
    // The documented tolerance: 1e-5 of the box's diagonal, 2 sqrt(2).
    for (size_t s = 0; s < set.segments.size(); ++s)
        for (float u : {0.1f, 0.3f, 0.6f, 0.8f})
            EXPECT_NEAR(glm::length(vec3(at(set, s, u))), 1.0f, 2.9e-5f);
}

TEST(NurbsCurves, primvarsOfEachInterpolation) {
    NurbsCurves curves = cubic();
    std::vector<float> x;
    for (const vec3& p : curves.points.first())
        x.push_back(p.x);
    curves.primvars.push_back(makePrimvar("x", Interpolation::Vertex, 1, x));
    curves.primvars.push_back(makePrimvar("k", Interpolation::Varying, 1, {1, 2, 3, 4, 5}));
    curves.primvars.push_back(makePrimvar("c", Interpolation::Uniform, 1, {8, 9}));
    const CurveSet set = drawn(curves);
    EXPECT_EQ(set.attribute("k")->data, (std::vector<float>{1, 2, 2, 3, 4, 5}));
    EXPECT_EQ(set.attribute("c")->data, (std::vector<float>{8, 9}));
    for (size_t s = 0; s < 3; ++s)
        for (size_t end = 0; end < 2; ++end)
            EXPECT_NEAR(set.attribute("x")->data[2 * s + end], at(set, s, float(end)).x, 1e-6f);
}

TEST(NurbsCurves, onlyTheRangeIsDrawn) {
    NurbsCurves curves = cubic();
    curves.ranges = {0.5, 1.5, 3.0, 4.0};
    const CurveSet part = drawn(curves);
    curves.ranges.clear();
    const CurveSet whole = drawn(curves);
    ASSERT_EQ(part.segments.size(), 3u);
    EXPECT_LT(glm::distance(vec3(at(part, 0, 0.0f)), vec3(at(whole, 0, 0.5f))), 1e-6f);
    EXPECT_LT(glm::distance(vec3(at(part, 1, 1.0f)), vec3(at(whole, 1, 0.25f))), 1e-6f);
}

TEST(NurbsCurves, badCurvesAreReportedAndTheRestIsDrawn) {
    const auto check = [](const char* input, const auto& change) {
        NurbsCurves curves = cubic();
        change(curves);
        Diagnostics diagnostics;
        const auto bezier = toBezier(curves, diagnostics);
        EXPECT_TRUE(warned(diagnostics, "/curves", input)) << input;
        EXPECT_EQ(bezier->curveVertexCounts.size(), 1u) << input;
        EXPECT_EQ(build(*bezier).segments.empty(), false) << input;
    };
    check("order", [](NurbsCurves& c) { c.orders[1] = 1; });
    check("order", [](NurbsCurves& c) { c.orders.pop_back(); });
    check("order", [](NurbsCurves& c) { c.orders[1] = std::numeric_limits<int>::min(); });
    check("curveVertexCounts", [](NurbsCurves& c) { c.orders[1] = 5; });
    check("curveVertexCounts", [](NurbsCurves& c) { c.points.values[0].pop_back(); });
    check("knots", [](NurbsCurves& c) { c.knots.pop_back(); });
    check("knots", [](NurbsCurves& c) { c.knots[12] = -3.0; });
    NurbsCurves none;
    none.path = "/curves";
    Diagnostics diagnostics;
    EXPECT_TRUE(toBezier(none, diagnostics)->curveVertexCounts.empty());
}

TEST(NurbsCurves, withoutAnOrderAreLines) {
    NurbsCurves curves = cubic();
    curves.orders.clear();
    curves.knots = {0.0, 0.0, 1.0, 1.0};
    Diagnostics diagnostics;
    const auto lines = toBezier(curves, diagnostics);
    EXPECT_TRUE(warned(diagnostics, "/curves", "order"));
    EXPECT_EQ(lines->basis, CurveBasis::Linear);
    EXPECT_EQ(lines->curveVertexCounts, curves.curveVertexCounts);
    EXPECT_EQ(lines->points.first(), curves.points.first());
    EXPECT_FALSE(build(*lines).segments.empty());
}

TEST(NurbsCurves, moveWithTheirPoints) {
    NurbsCurves curves = cubic();
    std::vector<vec3> moved = curves.points.first();
    for (vec3& p : moved)
        p.z += 3.0f;
    curves.points.times = {0.0f, 1.0f};
    curves.points.values.push_back(moved);
    Diagnostics diagnostics;
    TessellationOptions options;
    options.shutterClose = 1.0f;
    const CurveSet set = buildCurves(*toBezier(curves, diagnostics), options, diagnostics);
    ASSERT_EQ(set.controlPoints.size(), 2u);
    EXPECT_NEAR(set.controlPoints[1][2].z - set.controlPoints[0][2].z, 3.0f, 1e-5f);
}

} // namespace
} // namespace patina

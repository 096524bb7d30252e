// SPDX-License-Identifier: Apache-2.0
// Hermite and NURBS curves as Bezier ones.

#include "hdDelegate/geometry/curveForms.h"
#include "hdDelegate/geometry/curveSegments.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"

namespace patina {
namespace {

template <class T> CurveSet drawn(const T& curves) {
    Diagnostics diagnostics;
    const auto bezier = toBezier(curves, diagnostics);
    expectSilence(diagnostics);
    EXPECT_EQ(bezier->basis, CurveBasis::Bezier);
    return build(*bezier);
}

/// The Bezier curves of ones that something is said of.
template <class T>
std::shared_ptr<const Curves> warnedOf(const T& curves, const std::string& input) {
    Diagnostics diagnostics;
    const auto bezier = toBezier(curves, diagnostics);
    EXPECT_TRUE(warned(diagnostics, "/curves", input)) << input;
    return bezier;
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
    const std::vector<vec3>&points = curves.points.first(), &tangents = curves.tangents.first();
    const size_t firsts[] = {0, 1, 3};
    for (size_t s = 0; s < 3; ++s)
        for (float u : {0.0f, 0.25f, 0.5f, 0.9f, 1.0f}) {
            const vec3 a = points[firsts[s]], b = points[firsts[s] + 1];
            const vec3 ta = tangents[firsts[s]], tb = tangents[firsts[s] + 1];
            const float v = 1.0f - u;
            const vec3 truth =
                v * v * (1 + 2 * u) * a + u * v * v * ta + u * u * (1 + 2 * v) * b - u * u * v * tb;
            EXPECT_LT(glm::distance(vec3(evaluate(set, s, u)), truth), 1e-6f) << s << " " << u;
        }
    EXPECT_NEAR(evaluate(set, 0, 0.5f).w, 1.5f, 1e-6f); // radii are linear between points
    EXPECT_NEAR(evaluate(set, 1, 0.25f).w, 2.5f, 1e-6f);
}

TEST(HermiteCurves, valuesPerPointAndPerCurve) {
    HermiteCurves curves = hermite();
    curves.primvars = {makePrimvar("v", Interpolation::Vertex, 1, {0, 1, 2, 3, 4}),
                       makePrimvar("c", Interpolation::Uniform, 1, {10, 20})};
    const CurveSet set = drawn(curves);
    EXPECT_EQ(set.attribute("v")->data, (std::vector<float>{0, 1, 1, 2, 3, 4}));
    EXPECT_EQ(set.attribute("c")->data, (std::vector<float>{10, 20}));
}

TEST(HermiteCurves, tangentsThatDoNotFitAreReported) {
    HermiteCurves curves = hermite();
    curves.tangents.values[0].pop_back();
    EXPECT_EQ(build(*warnedOf(curves, "tangents")).segments.size(), 3u);
}

TEST(HermiteCurves, shortCurvesAreLeftOutAndTheRestKeepsItsValues) {
    HermiteCurves curves = hermite();
    curves.curveVertexCounts = {1, 2, 2};
    curves.primvars.push_back(makePrimvar("c", Interpolation::Uniform, 1, {10, 20, 30}));
    curves.subsets = {{"/curves/s", "/m", {0, 2}}};
    const CurveSet set = build(*warnedOf(curves, "curveVertexCounts"));
    EXPECT_EQ(set.segments.size(), 2u);
    EXPECT_EQ(set.attribute("c")->data, (std::vector<float>{20, 30}));
    EXPECT_EQ(set.segmentSubset, (std::vector<uint16_t>{0, 1}));
    EXPECT_NEAR(evaluate(set, 0, 0.0f).w, 2.0f, 1e-6f);
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
            EXPECT_NEAR(glm::length(vec3(evaluate(set, s, u))), 1.0f, 2.9e-5f);
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
        for (const float u : {0.0f, 0.4f, 1.0f})
            EXPECT_NEAR(valueOf(set, "x", unsigned(s), u).x, evaluate(set, s, u).x, 1e-5f);
}

TEST(NurbsCurves, onlyTheRangeIsDrawn) {
    NurbsCurves curves = cubic();
    curves.ranges = {0.5, 1.5, 3.0, 4.0};
    const CurveSet part = drawn(curves);
    curves.ranges.clear();
    const CurveSet whole = drawn(curves);
    ASSERT_EQ(part.segments.size(), 3u);
    EXPECT_LT(glm::distance(vec3(evaluate(part, 0, 0.0f)), vec3(evaluate(whole, 0, 0.5f))), 1e-6f);
    EXPECT_LT(glm::distance(vec3(evaluate(part, 1, 1.0f)), vec3(evaluate(whole, 1, 0.25f))), 1e-6f);
}

TEST(NurbsCurves, badCurvesAreReportedAndTheRestIsDrawn) {
    const auto check = [](const char* input, const auto& change) {
        NurbsCurves curves = cubic();
        change(curves);
        Diagnostics diagnostics;
        const auto bezier = warnedOf(curves, input);
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
    const auto lines = warnedOf(curves, "order");
    EXPECT_EQ(lines->basis, CurveBasis::Linear);
    EXPECT_EQ(lines->curveVertexCounts, curves.curveVertexCounts);
    EXPECT_EQ(lines->points.first(), curves.points.first());
    EXPECT_FALSE(build(*lines).segments.empty());
}

TEST(NurbsCurves, moveWithTheirPoints) {
    NurbsCurves curves = cubic();
    movePoints(curves, [](const vec3& p) { return p + vec3(0, 0, 3); });
    Diagnostics diagnostics;
    const CurveSet set = buildCurves(*toBezier(curves, diagnostics), shutter(0, 1), diagnostics);
    ASSERT_EQ(set.controlPoints.size(), 2u);
    EXPECT_NEAR(set.controlPoints[1][2].z - set.controlPoints[0][2].z, 3.0f, 1e-5f);
}

} // namespace
} // namespace patina

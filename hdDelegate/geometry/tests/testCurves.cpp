// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tests/meshFixtures.h"

#include <sys/resource.h>

#include <numeric>
#include <set>

namespace patina {
namespace {

Curves makeCurves(CurveBasis basis, CurveWrap wrap, std::vector<int> counts,
                  std::vector<vec3> points) {
    Curves curves;
    curves.path = "/curves";
    curves.basis = basis;
    curves.wrap = wrap;
    curves.curveVertexCounts = std::move(counts);
    curves.points = std::move(points);
    return curves;
}

std::vector<vec3> line(int n) {
    std::vector<vec3> points;
    for (int i = 0; i < n; ++i)
        points.push_back(vec3(i, i * i, 0.5f * i));
    return points;
}

void expectNear(const vec4& a, const vec3& b) {
    EXPECT_LT(glm::length(vec3(a) - b), 1e-5f);
}

TEST(CurveLayout, segmentCountsAreThoseOfUsd) {
    using B = CurveBasis;
    using W = CurveWrap;
    const auto segments = [](int n, B basis, W wrap) {
        return curveLayout(n, basis, wrap).segments;
    };
    for (int n : {2, 3, 5}) // the table of UsdGeomBasisCurves
        EXPECT_EQ(segments(n, B::Linear, W::Nonperiodic), n - 1);
    EXPECT_EQ(segments(10, B::Bezier, W::Nonperiodic), 3);
    EXPECT_EQ(segments(7, B::Bspline, W::Nonperiodic), 4);
    EXPECT_EQ(segments(9, B::Bezier, W::Periodic), 3);
    EXPECT_EQ(segments(7, B::Linear, W::Periodic), 7);
    EXPECT_EQ(segments(6, B::CatmullRom, W::Periodic), 6);
    EXPECT_EQ(segments(2, B::CatmullRom, W::Pinned), 1);
    EXPECT_EQ(segments(6, B::Bspline, W::Pinned), 5);
    EXPECT_EQ(segments(4, B::Bezier, W::Pinned), 1);
    EXPECT_EQ(varyingCount(curveLayout(10, B::Bezier, W::Nonperiodic), W::Nonperiodic), 4);
    EXPECT_EQ(varyingCount(curveLayout(6, B::Bezier, W::Periodic), W::Periodic), 2);
    for (B basis : {B::Linear, B::Bezier, B::Bspline, B::CatmullRom})
        for (W wrap : {W::Nonperiodic, W::Periodic, W::Pinned})
            for (int n = -1; n < 12; ++n) {
                const CurveLayout layout = curveLayout(n, basis, wrap);
                for (const auto& p : layout.points)
                    EXPECT_TRUE(p.a >= 0 && p.a < n && p.b < n);
                if (layout.segments > 0) {
                    EXPECT_GE(int(layout.points.size()),
                              (layout.segments - 1) * layout.step + (basis == B::Linear ? 2 : 4));
                }
            }
}

TEST(CurveBasisWeights, sumToOneAndMatchTheirBezierForm) {
    const float p[4] = {1.0f, -2.0f, 4.0f, 3.0f};
    for (auto basis : {CurveBasis::Bezier, CurveBasis::Bspline, CurveBasis::CatmullRom}) {
        float bezier[4] = {};
        toBezier(basis, p, bezier);
        for (float u : {0.0f, 0.3f, 0.5f, 1.0f}) {
            const vec4 w = basisWeights(basis, u), b = basisWeights(CurveBasis::Bezier, u);
            EXPECT_NEAR(w.x + w.y + w.z + w.w, 1.0f, 1e-6f);
            EXPECT_NEAR(glm::dot(w, vec4(p[0], p[1], p[2], p[3])),
                        glm::dot(b, vec4(bezier[0], bezier[1], bezier[2], bezier[3])), 1e-5f);
        }
    }
}

TEST(Curves, passThroughTheirPoints) {
    using W = CurveWrap;
    using B = CurveBasis;
    const auto p = line(7);
    const struct {
        B basis;
        W wrap;
        std::vector<int> counts;
        size_t segments;
        std::vector<std::tuple<size_t, float, vec3>> places; ///< segment, u, where that is
    } cases[] = {
        {B::Linear,
         W::Nonperiodic,
         {3, 2},
         3,
         {{0, 0, p[0]}, {1, 1, p[2]}, {2, 0.5f, 0.5f * (p[3] + p[4])}}},
        {B::Bezier, W::Nonperiodic, {7}, 2, {{0, 0, p[0]}, {0, 1, p[3]}, {1, 1, p[6]}}},
        {B::CatmullRom, W::Nonperiodic, {5}, 2, {{0, 0, p[1]}, {1, 1, p[3]}}},
        {B::CatmullRom,
         W::Pinned,
         {5},
         4,
         {{0, 0, p[0]}, {1, 0, p[1]}, {2, 0, p[2]}, {3, 0, p[3]}, {3, 1, p[4]}}},
        {B::Bspline,
         W::Nonperiodic,
         {5},
         2,
         {{0, 0, (p[0] + 4.0f * p[1] + p[2]) / 6.0f}, {1, 1, (p[2] + 4.0f * p[3] + p[4]) / 6.0f}}},
        {B::Bspline,
         W::Pinned,
         {2, 3},
         3,
         {{0, 0, p[0]}, {0, 1, p[1]}, {1, 0, p[2]}, {2, 1, p[4]}}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE("basis " + std::to_string(int(c.basis)) + " wrap " +
                     std::to_string(int(c.wrap)));
        const int n = std::accumulate(c.counts.begin(), c.counts.end(), 0);
        const CurveSet set = build(makeCurves(c.basis, c.wrap, c.counts, line(n)));
        ASSERT_EQ(set.segments.size(), c.segments);
        for (const auto& [segment, u, place] : c.places)
            expectNear(evaluate(set, segment, u), place);
    }
}

TEST(Curves, segmentsKnowTheirCurve) {
    const CurveSet set =
        build(makeCurves(CurveBasis::Linear, CurveWrap::Nonperiodic, {3, 2}, line(5)));
    EXPECT_EQ(set.segmentCurve, (std::vector<int>{0, 0, 1}));
    EXPECT_EQ(set.segmentU[1], vec2(0.5f, 1.0f));
    EXPECT_EQ(evaluate(set, 0, 0.0f).w, 0.5f) << "width 1 without widths";
}

TEST(Curves, periodicOnesClose) {
    const std::vector<vec3> ring = {{1, 0, 0},  {1, 1, 0},  {0, 1, 0},
                                    {-1, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    for (auto basis :
         {CurveBasis::Linear, CurveBasis::Bezier, CurveBasis::Bspline, CurveBasis::CatmullRom}) {
        const CurveSet set = build(makeCurves(basis, CurveWrap::Periodic, {6}, ring));
        ASSERT_EQ(set.segments.size(), basis == CurveBasis::Bezier ? 2u : 6u);
        for (size_t s = 0; s < set.segments.size(); ++s)
            expectNear(evaluate(set, s, 1), vec3(evaluate(set, (s + 1) % set.segments.size(), 0)));
    }
}

TEST(Curves, widthsOfEveryInterpolation) {
    Curves curves = makeCurves(CurveBasis::Bspline, CurveWrap::Nonperiodic, {5, 4}, line(9));
    curves.primvars = {makePrimvar("widths", Interpolation::Constant, 1, {3})};
    EXPECT_FLOAT_EQ(evaluate(build(curves), 2, 0.7f).w, 1.5f);
    for (const Interpolation one :
         {Interpolation::Uniform, Interpolation::Vertex, Interpolation::Varying}) {
        curves.primvars = {makePrimvar("widths", one, 1, {3})};
        EXPECT_FLOAT_EQ(evaluate(build(curves), 2, 0.7f).w, 1.5f) << "one value is for all";
    }
    curves.primvars = {makePrimvar("widths", Interpolation::Uniform, 1, {3, 5})};
    EXPECT_FLOAT_EQ(evaluate(build(curves), 0, 0.7f).w, 1.5f);
    EXPECT_FLOAT_EQ(evaluate(build(curves), 2, 0.7f).w, 2.5f);
    curves.primvars = {
        makePrimvar("widths", Interpolation::Vertex, 1, {6, 0, 6, 0, 0, 0, 0, 0, 0})};
    EXPECT_FLOAT_EQ(evaluate(build(curves), 0, 0).w, 0.5f * 12 / 6);
    curves.primvars = {makePrimvar("widths", Interpolation::Varying, 1, {0, 2, 4, 8, 10})};
    const CurveSet set = build(curves);
    EXPECT_EQ(set.basis, CurveBasis::Bezier) << "linear widths need points of their own";
    EXPECT_NEAR(evaluate(set, 0, 0.25f).w, 0.25f, 1e-6f);
    EXPECT_NEAR(evaluate(set, 1, 0.5f).w, 1.5f, 1e-6f);
    EXPECT_NEAR(evaluate(set, 2, 0.5f).w, 4.5f, 1e-6f);
    // The shape is the same as before.
    curves.primvars.clear();
    const CurveSet native = build(curves);
    for (size_t s = 0; s < 3; ++s)
        for (float u : {0.0f, 0.4f, 1.0f})
            expectNear(evaluate(set, s, u), vec3(evaluate(native, s, u)));
}

TEST(Curves, pinnedTaperHasNoNegativeRadius) {
    Curves curves = makeCurves(CurveBasis::Bspline, CurveWrap::Pinned, {4}, line(4));
    curves.primvars = {makePrimvar("widths", Interpolation::Vertex, 1, {0, 1, 1, 0})};
    const CurveSet set = build(curves);
    for (const vec4& p : set.controlPoints[0])
        EXPECT_GE(p.w, 0.0f);
    EXPECT_NEAR(evaluate(set, 0, 0).w, 0.0f, 1e-6f);
    expectNear(evaluate(set, 0, 0), curves.points.first()[0]);
}

TEST(Curves, pinnedVaryingWithOrWithoutEndSegments) {
    Curves curves = makeCurves(CurveBasis::Bspline, CurveWrap::Pinned, {5}, line(5));
    curves.primvars = {makePrimvar("widths", Interpolation::Varying, 1, {2, 4, 6, 8, 10})};
    EXPECT_NEAR(evaluate(build(curves), 3, 1).w, 5.0f, 1e-6f);
    curves.primvars = {makePrimvar("widths", Interpolation::Varying, 1, {2, 4, 6})};
    const CurveSet set = build(curves);
    EXPECT_NEAR(evaluate(set, 0, 0).w, 1.0f, 1e-6f);
    EXPECT_NEAR(evaluate(set, 1, 1).w, 2.0f, 1e-6f);
    EXPECT_NEAR(evaluate(set, 3, 1).w, 3.0f, 1e-6f);
}

TEST(Curves, ribbonsHaveUnitNormalsPerControlPoint) {
    for (auto basis : {CurveBasis::Linear, CurveBasis::Bspline, CurveBasis::Bezier}) {
        Curves curves = makeCurves(basis, CurveWrap::Nonperiodic, {4}, line(4));
        curves.primvars = {makePrimvar("normals", Interpolation::Constant, 3, {0, 0, 2})};
        const CurveSet set = build(curves);
        EXPECT_NE(set.basis, CurveBasis::Linear);
        ASSERT_EQ(set.normals.size(), 1u);
        ASSERT_EQ(set.normals[0].size(), set.controlPoints[0].size());
        for (const vec3& n : set.normals[0])
            expectNear(vec4(n, 0), vec3(0, 0, 1));
        if (basis == CurveBasis::Linear)
            expectNear(evaluate(set, 1, 0.5f), 0.5f * (line(4)[1] + line(4)[2]));
    }
}

TEST(Curves, ribbonsThatTurnAreSplit) {
    Curves curves = makeCurves(CurveBasis::Bezier, CurveWrap::Nonperiodic, {4, 4},
                               {{0, 0, 0},
                                {2, 0, 0},
                                {2, 1, 0},
                                {0, 1, 0}, // turns back
                                {0, 2, 0},
                                {1, 2, 0},
                                {2, 2, 0},
                                {3, 2, 0}});
    curves.primvars = {makePrimvar("normals", Interpolation::Constant, 3, {0, 0, 1}),
                       makePrimvar("widths", Interpolation::Varying, 1, {2, 4, 1, 1}),
                       makePrimvar("a", Interpolation::Varying, 1, {10, 20, 0, 1})};
    curves.subsets = {{"/curves/second", "", {1}}};
    const CurveSet set = build(curves);
    const unsigned pieces = unsigned(set.segments.size()) - 1;
    ASSERT_GT(pieces, 8u);
    for (unsigned s = 0; s < pieces; ++s)
        for (const float u : {0.0f, 0.5f, 1.0f}) {
            const float t = (float(s) + u) / float(pieces), w = 1.0f - t;
            expectNear(evaluate(set, s, u), 3 * w * w * t * vec3(2, 0, 0) +
                                                3 * w * t * t * vec3(2, 1, 0) +
                                                t * t * t * vec3(0, 1, 0));
            EXPECT_NEAR(valueOf(set, "a", s, u).x, 10 + 10 * t, 1e-4f);
            EXPECT_EQ(set.segmentCurve[s], 0);
        }
    EXPECT_EQ(set.segmentCurve.back(), 1); // straight: one piece
    EXPECT_EQ(set.segmentSubset.back(), 1);
    EXPECT_NEAR(set.controlPoints[0][set.segments[pieces - 1] + 3].w, 2.0f, 1e-5f);
    EXPECT_EQ(set.segmentU[pieces - 1].y, 1.0f);
}

TEST(Curves, attributesAtSegmentEnds) {
    Curves curves = makeCurves(CurveBasis::Bezier, CurveWrap::Nonperiodic, {7, 4}, line(11));
    std::vector<float> ramp(11);
    std::iota(ramp.begin(), ramp.end(), 0.0f);
    curves.primvars = {makePrimvar("vertex", Interpolation::Vertex, 1, ramp),
                       makePrimvar("varying", Interpolation::Varying, 1, {1, 2, 3, 4, 5}),
                       makePrimvar("uniform", Interpolation::Uniform, 1, {7, 8}),
                       makePrimvar("constant", Interpolation::Constant, 1, {9})};
    curves.subsets = {{"/curves/second", "", {1}}};
    const CurveSet set = build(curves);
    const auto value = [&](const char* name, unsigned segment, float u) {
        return valueOf(set, name, segment, u).x;
    };
    EXPECT_FLOAT_EQ(value("vertex", 0, 1), 3);
    EXPECT_FLOAT_EQ(value("vertex", 1, 1), 6);
    EXPECT_FLOAT_EQ(value("vertex", 2, 0), 7);
    EXPECT_FLOAT_EQ(value("varying", 1, 0.5f), 2.5f);
    EXPECT_FLOAT_EQ(value("varying", 2, 0), 4);
    EXPECT_FLOAT_EQ(value("uniform", 2, 0.1f), 8);
    EXPECT_FLOAT_EQ(value("constant", 2, 0.1f), 9);
    EXPECT_EQ(set.segmentSubset, (std::vector<uint16_t>{0, 0, 1}));
}

TEST(Curves, vertexValuesFollowTheCurve) {
    const std::vector<vec3> points = {{0, 0, 0}, {1, 2, 0}, {0, 3, 1}, {3, 1, 2},
                                      {2, 0, 2}, {5, 1, 0}, {4, 4, 1}};
    std::vector<float> same;
    for (const vec3& p : points)
        same.insert(same.end(), {p.x, p.y, p.z});
    for (auto basis : {CurveBasis::Bezier, CurveBasis::Bspline, CurveBasis::CatmullRom})
        for (auto wrap : {CurveWrap::Nonperiodic, CurveWrap::Pinned, CurveWrap::Periodic})
            for (const bool ribbon : {false, true}) {
                const int count =
                    wrap == CurveWrap::Periodic && basis == CurveBasis::Bezier ? 6 : 7;
                Curves curves = makeCurves(basis, wrap, {count}, points);
                curves.points = std::vector<vec3>(points.begin(), points.begin() + count);
                curves.primvars = {makePrimvar("p", Interpolation::Vertex, 3,
                                               {same.begin(), same.begin() + 3 * count})};
                if (ribbon)
                    curves.primvars.push_back(
                        makePrimvar("normals", Interpolation::Constant, 3, {0, 0.6f, 0.8f}));
                const CurveSet set = build(curves);
                for (unsigned s = 0; s < set.segments.size(); ++s)
                    for (const float u : {0.0f, 0.3f, 0.5f, 0.9f, 1.0f})
                        expectNear(evaluate(set, s, u), vec3(valueOf(set, "p", s, u)));
            }
}

TEST(Curves, motion) {
    Curves curves = makeCurves(CurveBasis::Bspline, CurveWrap::Pinned, {4}, line(4));
    movePoints(curves, [](const vec3& p) { return p + vec3(2, 0, 0); });
    Diagnostics diagnostics;
    const CurveSet set = buildCurves(curves, shutter(0, 0.5f), diagnostics);
    ASSERT_EQ(set.controlPoints.size(), 2u);
    expectNear(evaluate(set, 0, 0, 1), vec3(1, 0, 0));
}

TEST(BadCurves, areReportedAndLeftOut) {
    Curves curves =
        makeCurves(CurveBasis::Bezier, CurveWrap::Nonperiodic, {3, 6, 4, -2, 4, 9}, line(20));
    curves.points.values[0][10].y = nan;
    curves.primvars = {makePrimvar("widths", Interpolation::Constant, 1, {-1}),
                       makePrimvar("odd", Interpolation::Vertex, 1, {1, 2, 3})};
    Diagnostics diagnostics;
    const CurveSet set = buildCurves(curves, {}, diagnostics);
    EXPECT_EQ(set.segmentCurve, (std::vector<int>{1, 4}));
    for (const char* input : {"curveVertexCounts", "points", "widths", "primvars:odd"})
        EXPECT_TRUE(warned(diagnostics, "/curves", input)) << input;
    EXPECT_EQ(set.controlPoints[0][0].w, 0.0f);
    for (const auto& p : set.controlPoints[0])
        EXPECT_TRUE(std::isfinite(p.y));
}

TEST(BadCurves, emptyOnes) {
    Diagnostics diagnostics;
    EXPECT_TRUE(
        buildCurves(makeCurves(CurveBasis::Linear, CurveWrap::Pinned, {}, {}), {}, diagnostics)
            .segments.empty());
    EXPECT_TRUE(warned(diagnostics, "/curves", "points"));
    Curves none;
    none.path = "/none";
    EXPECT_TRUE(buildCurves(none, {}, diagnostics).segments.empty());
}

Points makePoints(std::vector<vec3> positions) {
    Points points;
    points.path = "/points";
    points.points = std::move(positions);
    return points;
}

TEST(Points, widthsNormalsAndPrimvars) {
    Points points = makePoints(line(3));
    points.primvars = {
        makePrimvar("widths", Interpolation::Vertex, 1, {2, 4, 6}),
        makePrimvar("displayColor", Interpolation::Varying, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1})};
    points.subsets = {{"/points/a", "", {2}}};
    Diagnostics diagnostics;
    const PointSet set = buildPoints(points, {}, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0);
    EXPECT_EQ(set.points[0][1], vec4(1, 1, 0.5f, 2));
    EXPECT_TRUE(set.normals.empty());
    EXPECT_EQ(set.pointSubset, (std::vector<uint16_t>{0, 0, 1}));
    EXPECT_EQ(valueOf(set, "displayColor", 2u).z, 1.0f);
    points.primvars = {makePrimvar("normals", Interpolation::Constant, 3, {0, 5, 0}),
                       makePrimvar("widths", Interpolation::Vertex, 1, {3})};
    const PointSet disks = buildPoints(points, {}, diagnostics);
    EXPECT_EQ(disks.normals[0], (std::vector<vec3>(3, vec3(0, 1, 0))));
    EXPECT_EQ(disks.points[0][2].w, 1.5f);
}

TEST(Points, badOnesAreLeftOutWithTheirValues) {
    Points points = makePoints(line(3));
    points.points.values[0][1].x = inf;
    points.primvars = {makePrimvar("widths", Interpolation::Vertex, 1, {2, 4, -6}),
                       makePrimvar("id", Interpolation::Vertex, 1, {10, 11, 12})};
    Diagnostics diagnostics;
    const PointSet set = buildPoints(points, {}, diagnostics);
    EXPECT_EQ(set.pointIndex, (std::vector<int>{0, 2}));
    EXPECT_EQ(set.attribute("id")->data, (std::vector<float>{10, 12}));
    EXPECT_EQ(set.points[0][1].w, 0.0f);
    EXPECT_TRUE(warned(diagnostics, "/points", "points"));
    EXPECT_TRUE(warned(diagnostics, "/points", "widths"));
}

long peakMemory() { // kB that the process ever took
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

// A layout of a billion points would take 8 GB, one of a million 8 MB.
TEST(Curves, CountsBeyondThePointsTakeNoMemory) {
    for (CurveBasis basis : {CurveBasis::Linear, CurveBasis::Bezier, CurveBasis::CatmullRom}) {
        const Curves curves =
            makeCurves(basis, CurveWrap::Nonperiodic, {4, 1000000000, 4, -1, 4}, line(4));
        Diagnostics diagnostics;
        const long before = peakMemory();
        const CurveSet set = buildCurves(curves, {}, diagnostics);
        EXPECT_LT(peakMemory() - before, 8192);
        EXPECT_EQ(std::set<int>(set.segmentCurve.begin(), set.segmentCurve.end()),
                  std::set<int>{0});
        ASSERT_GE(diagnostics.count(), 1);
        EXPECT_EQ(diagnostics.all()[0].prim, "/curves");
        EXPECT_EQ(diagnostics.all()[0].input, "curveVertexCounts");
    }
}

} // namespace
} // namespace patina

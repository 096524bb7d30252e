// SPDX-License-Identifier: Apache-2.0
// Trim curves of NURBS patches.

#include "hdDelegate/geometry/tests/patchFixtures.h"
#include "hdDelegate/scene/primCompare.h"

#include <map>
#include <random>

namespace patina {
namespace {

using glm::dvec2;
constexpr double pi = 3.14159265358979323846;

/// A square from 0 to 2 in the plane z = 0, with parameters 0 to 1.
NurbsPatch squarePatch() {
    NurbsPatch patch;
    patch.u = patch.v = {2, 2, {0, 0, 1, 1}};
    return patch;
}

Mesh square(const NurbsPatch& patch) {
    return patchMesh(patch, {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}});
}
/// A quarter turn for each span, counterclockwise.
void addCircle(TrimCurves& trim, const dvec2& middle, double radius) {
    const double w = std::sqrt(0.5), x[] = {1, 1, 0, -1, -1, -1, 0, 1, 1};
    for (int i = 0; i < 9; ++i) {
        const double weight = i % 2 ? w : 1.0, y = x[(i + 6) % 8];
        trim.points.push_back(weight * (middle.x + radius * x[i]));
        trim.points.push_back(weight * (middle.y + radius * y));
        trim.points.push_back(weight);
    }
    for (const double knot : {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4})
        trim.knots.push_back(knot);
    trim.counts.push_back(1);
    trim.orders.push_back(3);
    trim.vertexCounts.push_back(9);
}

void addPolygon(TrimCurves& trim, std::vector<dvec2> corners) {
    corners.push_back(corners[0]);
    for (size_t i = 0; i < corners.size(); ++i) {
        trim.points.insert(trim.points.end(), {corners[i].x, corners[i].y, 1.0});
        trim.knots.push_back(double(i));
    }
    trim.knots.insert(trim.knots.end(), {1e9, 1e9});
    std::sort(trim.knots.end() - 2 - long(corners.size()), trim.knots.end());
    trim.knots[trim.knots.size() - 2] = trim.knots.back() = double(corners.size());
    trim.counts.push_back(1);
    trim.orders.push_back(2);
    trim.vertexCounts.push_back(int(corners.size()));
}

/// Edges that only one triangle has; each edge has two at most, in opposite directions.
std::vector<uvec2> outline(const TriangleMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> count;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(++count[std::make_pair(t[k], t[(k + 1) % 3])], 1);
    std::vector<uvec2> edges;
    for (const auto& item : count)
        if (!count.count({item.first.second, item.first.first}))
            edges.push_back({item.first.first, item.first.second});
    return edges;
}

dvec2 parameters(const TriangleMesh& mesh, uint32_t vertex) {
    const std::vector<float>& st = mesh.attribute("st")->data;
    return {double(st[2 * vertex]), double(st[2 * vertex + 1])};
}

TEST(TrimCurves, circleIsCutOutOfASquare) {
    NurbsPatch patch = squarePatch();
    addCircle(patch.trim, {0.5, 0.45}, 0.3);
    const double radius = 0.6, circle = pi * radius * radius;
    for (const double edge : {0.0, 0.1, 0.03}) {
        patch.trim.keepInside = false;
        const double outside = surfaceArea(draw(square(patch), float(edge)));
        patch.trim.keepInside = true;
        const TriangleMesh inside = draw(square(patch), float(edge));
        EXPECT_NEAR(outside + surfaceArea(inside), 4.0, 1e-5);
        // A polygon in a circle, whose sides see angles up to a, lacks up to a^2 / 6 of its area.
        // Without an edge a quarter turn has four sides, none of which sees more than 0.45.
        const double angle = edge > 0.0 ? 2.0 * std::asin(0.5 * edge / radius) : 0.45;
        EXPECT_LE(surfaceArea(inside), circle + 1e-5);
        EXPECT_GE(surfaceArea(inside), circle * (1.0 - angle * angle / 6.0) - 1e-5);
        for (const uvec2& e : outline(inside)) // where a side crosses a line, it is on the side
            for (const uint32_t end : {e.x, e.y}) {
                const double distance = glm::distance(parameters(inside, end), dvec2(0.5, 0.45));
                EXPECT_LE(distance, 0.3 + 2e-7);
                EXPECT_GE(distance, 0.3 * std::cos(0.5 * angle) - 2e-7);
            }
    }
}

TEST(TrimCurves, loopsNest) {
    NurbsPatch patch = squarePatch();
    addPolygon(patch.trim, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}); // the patch's own outline
    addPolygon(patch.trim, {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}});
    addPolygon(patch.trim, {{0.3, 0.7}, {0.7, 0.7}, {0.7, 0.3}, {0.3, 0.3}}); // the other way round
    patch.trim.keepInside = true;
    EXPECT_NEAR(surfaceArea(draw(square(patch))), 4.0 * (1.0 - 0.64 + 0.16), 1e-5);
    patch.trim.keepInside = false;
    EXPECT_NEAR(surfaceArea(draw(square(patch))), 4.0 * (0.64 - 0.16), 1e-5);
}

TEST(TrimCurves, loopOfSeveralCurvesThatReachesBeyondThePatch) {
    NurbsPatch patch = squarePatch();
    addPolygon(patch.trim, {{0.5, -3}, {7, -3}, {7, 9}, {0.5, 9}});
    patch.trim.counts = {2}; // the same corners as two curves
    patch.trim.orders = {2, 2};
    patch.trim.vertexCounts = {3, 3};
    patch.trim.points = {0.5, -3, 1, 7, -3, 1, 7, 9, 1, 7, 9, 1, 0.5, 9, 1, 0.5, -3, 1};
    patch.trim.knots = {0, 0, 1, 2, 2, 0, 0, 1, 2, 2};
    patch.trim.ranges = {0, 2, 0, 2};
    const TriangleMesh drawn = draw(square(patch));
    EXPECT_NEAR(surfaceArea(drawn), 2.0, 1e-6);
    EXPECT_NEAR(drawn.boundsMax.x, 1.0f, 1e-6f);
}

TEST(TrimCurves, capOfASphere) {
    // u goes around, v from the south pole to the north; the cap below v = 0.7 is cut off.
    Mesh mesh = spherePatch();
    NurbsPatch patch = *mesh.patch;
    const double v = 0.7, w = std::sqrt(0.5);
    addPolygon(patch.trim, {{0, 0}, {4, 0}, {4, v}, {0, v}});
    mesh.patch = std::make_shared<NurbsPatch>(patch);
    const double edge = 0.05;
    const TriangleMesh drawn = draw(mesh, float(edge));
    // Seen from the middle, triangles cover what is left (Van Oosterom and Strackee 1983).
    double seen = 0.0;
    for (const uvec3& t : drawn.triangles) {
        const dvec3 a(drawn.positions[0][t.x]), b(drawn.positions[0][t.y]),
            c(drawn.positions[0][t.z]);
        seen += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                                 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    }
    // At v the quadratic of a quarter turn has this height and radius.
    const double weight = (1 - v) * (1 - v) + 2 * v * (1 - v) * w + v * v;
    const double height = -((1 - v) * (1 - v) + 2 * v * (1 - v) * w) / weight;
    const double radius = std::sqrt(1.0 - height * height);
    const double angle = 2.0 * std::asin(0.5 * edge / radius);
    EXPECT_NEAR(seen, 2.0 * pi * (1.0 - height), pi * radius * radius * angle * angle / 6.0);
    for (size_t i = 0; i < drawn.positions[0].size(); ++i) {
        EXPECT_NEAR(glm::length(drawn.positions[0][i]), 1.0f, 2e-7f);
        EXPECT_GT(drawn.positions[0][i].z, height - 1e-6);
    }
}

TEST(TrimCurves, anyLoopsLeaveWhatRaysTell) {
    // Loops that cross themselves and each other, on a patch with several cells and with edges.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-0.1, 1.1);
    for (int round = 0; round < 60; ++round) {
        NurbsPatch patch = squarePatch();
        patch.u = {4, 2, {0, 0, 0.3, 0.6, 1, 1}};
        std::vector<std::vector<dvec2>> loops(size_t(1 + round % 4));
        for (auto& loop : loops) {
            for (int i = 0; i < 3 + round % 7; ++i)
                loop.push_back({uniform(random), uniform(random)});
            if (round % 3 == 0) // corners on lines of the grid, and sides along them
                for (dvec2& p : loop)
                    p = glm::round(p * 10.0) / 10.0;
            if (round % 5 == 0) // and back again beside itself, by a few steps of the parameters
                for (size_t i = loop.size(); i-- > 0;)
                    loop.push_back(loop[i] + 2e-7 * dvec2(uniform(random), uniform(random)));
            addPolygon(patch.trim, loop);
        }
        const TriangleMesh drawn = draw(patchMesh(patch, {{0, 0, 0},
                                                          {0.3, 0, 0},
                                                          {0.6, 0, 0},
                                                          {1, 0, 0},
                                                          {0, 1, 0},
                                                          {0.3, 1, 0},
                                                          {0.6, 1, 0},
                                                          {1, 1, 0}}));
        outline(drawn);
        for (int k = 0; k < 200; ++k) {
            const dvec2 p(0.5 + 0.4 * uniform(random), 0.5 + 0.4 * uniform(random));
            bool inside = false;
            double nearest = 1.0;
            for (const auto& loop : loops)
                for (size_t i = 0; i < loop.size(); ++i) {
                    const dvec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
                    const dvec2 way = b - a;
                    const double along =
                        std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
                    if (a != b) nearest = std::min(nearest, glm::distance(p, a + along * way));
                    if ((a.y <= p.y) != (b.y <= p.y) &&
                        a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) < p.x)
                        inside = !inside;
                }
            if (nearest < 1e-5) continue; // parameters count steps of 6e-8
            int covered = 0;
            for (const uvec3& t : drawn.triangles) {
                const auto side = [&](int i) {
                    const dvec2 a(drawn.positions[0][t[i]]);
                    const dvec2 b(drawn.positions[0][t[(i + 1) % 3]]);
                    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
                };
                covered += side(0) > 0.0 && side(1) > 0.0 && side(2) > 0.0;
            }
            EXPECT_EQ(covered, inside ? 0 : 1) << "round " << round << " at " << p.x << " " << p.y;
        }
    }
}

TEST(TrimCurves, manySmallLoopsInOneCell) {
    NurbsPatch patch = squarePatch();
    for (int i = 0; i < 400; ++i)
        addCircle(patch.trim, {(i % 20 + 0.5) / 20.0, (i / 20 + 0.5) / 20.0}, 0.01);
    const double circle = 400.0 * pi * 0.02 * 0.02;
    const TriangleMesh drawn = draw(square(patch));
    outline(drawn);
    EXPECT_LE(4.0 - surfaceArea(drawn), circle);
    EXPECT_GE(4.0 - surfaceArea(drawn), circle * (1.0 - 0.45 * 0.45 / 6.0)); // as of the one circle
}

TEST(TrimCurves, nothingIsLeft) {
    NurbsPatch patch = squarePatch();
    addPolygon(patch.trim, {{-1, -1}, {2, -1}, {2, 2}, {-1, 2}});
    EXPECT_TRUE(draw(square(patch)).triangles.empty());
}

TEST(TrimCurves, unsoundLoopsAreLeftOut) {
    const auto check = [](const char* input, const auto& change) {
        NurbsPatch patch = squarePatch();
        addCircle(patch.trim, {0.5, 0.5}, 0.2);
        change(patch.trim);
        Diagnostics diagnostics;
        EXPECT_NEAR(surfaceArea(tessellate(square(patch), {}, diagnostics)), 4.0, 1e-6) << input;
        EXPECT_TRUE(warned(diagnostics, "/patch", input)) << input;
        EXPECT_EQ(diagnostics.count(), 1) << input;
    };
    check("trimCurve:counts", [](TrimCurves& t) { t.counts = {2}; });
    check("trimCurve:counts", [](TrimCurves& t) { t.counts = {-1}; });
    check("trimCurve:counts", [](TrimCurves& t) { t.counts = {std::numeric_limits<int>::max()}; });
    check("trimCurve:orders", [](TrimCurves& t) { t.orders = {}; });
    check("trimCurve:orders", [](TrimCurves& t) { t.orders = {99}; });
    check("trimCurve:vertexCounts", [](TrimCurves& t) { t.vertexCounts = {2}; });
    check("trimCurve:counts", [](TrimCurves& t) { t.vertexCounts = {}; });
    check("trimCurve:knots", [](TrimCurves& t) { t.knots = {}; });
    check("trimCurve:knots", [](TrimCurves& t) { t.knots[5] = -1.0; });
    check("trimCurve:points", [](TrimCurves& t) { t.points.pop_back(); });
    check("trimCurve:points", [](TrimCurves& t) { t.points = {}; });
    check("trimCurve:points", [](TrimCurves& t) { t.points[2] = 0.0; });
    check("trimCurve:points", [](TrimCurves& t) { t.points[4] = INFINITY; });
    check("trimCurve:points", [](TrimCurves& t) { t.points[1] = 0.9; }); // does not close
    NurbsPatch patch = squarePatch();
    addCircle(patch.trim, {0.5, 0.5}, 0.2);
    patch.trim.ranges = {0, 1, 2};
    Diagnostics diagnostics;
    EXPECT_LT(surfaceArea(tessellate(square(patch), {}, diagnostics)), 3.6);
    EXPECT_TRUE(warned(diagnostics, "/patch", "trimCurve:ranges"));
}

TEST(TrimCurves, otherCurvesAreAnotherShape) {
    NurbsPatch patch = squarePatch();
    addCircle(patch.trim, {0.5, 0.5}, 0.2);
    const Mesh mesh = square(patch);
    EXPECT_TRUE(sameShape(mesh, square(patch)));
    patch.trim.points[0] += 0.01;
    EXPECT_FALSE(sameShape(mesh, square(patch)));
}

} // namespace
} // namespace patina

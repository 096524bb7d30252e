// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterShapes.h"

#include "hdDelegate/geometry/tangentFrames.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float twoPi = 2.0f * pi;
constexpr size_t maxCurveTriangles = 4000000; ///< of a prim all around the camera

using Rate = MeshAttribute::Rate;

/// Grows a mesh whose normals stand on its vertices.
struct Builder {
    TriangleMesh mesh;
    std::vector<vec3> positions, normals;

    uint32_t add(const vec3& p, const vec3& n) {
        positions.push_back(p);
        normals.push_back(n);
        return uint32_t(positions.size()) - 1;
    }
    /// @param subset as TriangleMesh::triangleSubset
    void triangle(uint32_t a, uint32_t b, uint32_t c, int element, int subset) {
        mesh.triangles.emplace_back(a, b, c);
        mesh.triangleFace.push_back(element);
        mesh.triangleSubset.push_back(uint16_t(subset));
    }
    TriangleMesh finish() {
        mesh.boundsMin = vec3(INFINITY);
        mesh.boundsMax = vec3(-INFINITY);
        for (const vec3& p : positions) {
            mesh.boundsMin = glm::min(mesh.boundsMin, p);
            mesh.boundsMax = glm::max(mesh.boundsMax, p);
        }
        mesh.positions = {std::move(positions)};
        mesh.normals = {std::move(normals)};
        return std::move(mesh);
    }
};

/// Sides of a circle that leave it by so much, when as wide as it in the mean.
int sidesFor(float radius, float gap) {
    if (!(gap > 0.0f)) return 16;
    return std::clamp(2 * int(std::ceil(0.25f * twoPi * std::sqrt(radius / (3.0f * gap)))), 6, 64);
}

/// How a point is drawn.
struct PointForm {
    int columns = 0, rows = 0;
    float wider = 1.0f; ///< than the circle, so that it is as wide in the mean

    PointForm(float radius, float gap, bool disk) {
        // Disks have hard edges; balls are lit by their facets as well, so they take twice as many.
        columns = sidesFor(radius, disk ? gap : 0.25f * gap);
        rows = disk ? 1 : std::max(columns / 2, 4);
        const float angle = twoPi / float(columns);
        wider = disk ? std::sqrt(angle / std::sin(angle)) : 0.5f * angle / std::sin(0.5f * angle);
    }
    size_t triangles() const { return size_t(columns) * size_t(rows == 1 ? 1 : 2 * rows - 2); }
};

/// The gap with which points take so many triangles at most, as far as that is possible.
float fitPoints(const PointSet& set, float gap, size_t maximum) {
    for (int i = 0; i < 24 && gap > 0.0f; ++i, gap *= 2.0f) {
        size_t sum = 0;
        for (const vec4& p : set.points[0])
            sum += PointForm(p.w, gap, !set.normals.empty()).triangles();
        if (sum <= maximum) break;
    }
    return gap;
}

TriangleMesh pointTriangles(const PointSet& set, const RasterFineness& fineness) {
    const float gap = fitPoints(set, fineness.gap, fineness.pointTriangles);
    Builder out;
    for (const MeshAttribute& a : set.attributes) {
        MeshAttribute copy = a;
        if (a.rate == Rate::PerVertex) copy.data.clear();
        out.mesh.attributes.push_back(std::move(copy));
    }
    const bool disks = !set.normals.empty();
    for (size_t i = 0; i < set.points[0].size(); ++i) {
        const vec3 center = vec3(set.points[0][i]);
        const PointForm form(set.points[0][i].w, gap, disks);
        const int columns = form.columns, rows = form.rows;
        const float radius = set.points[0][i].w * form.wider;
        const int element = i < set.pointIndex.size() ? set.pointIndex[i] : int(i);
        const int subset = i < set.pointSubset.size() ? set.pointSubset[i] : 0;
        const size_t before = out.positions.size();
        if (disks) {
            const vec3 n = set.normals[0][i];
            vec3 x, y;
            orthonormalBasis(n, x, y);
            const uint32_t middle = out.add(center, n);
            for (int k = 0; k < columns; ++k) {
                const float phi = twoPi * float(k) / float(columns);
                out.add(center + (x * std::cos(phi) + y * std::sin(phi)) * radius, n);
            }
            for (int k = 0; k < columns; ++k)
                out.triangle(middle, middle + 1 + uint32_t(k),
                             middle + 1 + uint32_t((k + 1) % columns), element, subset);
        } else {
            const uint32_t first = uint32_t(before);
            for (int r = 0; r <= rows; ++r)
                for (int k = 0; k < columns; ++k) {
                    const float theta = 0.5f * twoPi * float(r) / float(rows);
                    const float phi = twoPi * float(k) / float(columns);
                    const vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 std::cos(theta));
                    out.add(center + n * radius, n);
                }
            for (int r = 0; r < rows; ++r)
                for (int k = 0; k < columns; ++k) {
                    const uint32_t a = first + uint32_t(r * columns + k);
                    const uint32_t b = first + uint32_t(r * columns + (k + 1) % columns);
                    const uint32_t c = a + uint32_t(columns), d = b + uint32_t(columns);
                    if (r > 0) out.triangle(a, c, b, element, subset);
                    if (r + 1 < rows) out.triangle(b, c, d, element, subset);
                }
        }
        for (size_t a = 0; a < set.attributes.size(); ++a) {
            const MeshAttribute& from = set.attributes[a];
            if (from.rate != Rate::PerVertex) continue;
            for (size_t v = before; v < out.positions.size(); ++v)
                for (int c = 0; c < from.components; ++c)
                    out.mesh.attributes[a].data.push_back(
                        from.data[i * size_t(from.components) + size_t(c)]);
        }
    }
    return out.finish();
}

} // namespace

RasterForm rasterTriangles(const PrimShape& shape, const RasterFineness& fineness) {
    RasterForm form;
    if (const CurveSet& set = shape.curves; !set.segments.empty()) {
        RasterFineness own = fineness;
        const bool thin = fitCurves(set, own, maxCurveTriangles);
        const bool domed = thin && domedStripsFit(set, own, maxCurveTriangles);
        form.seen = curveTriangles(set, own, thin, domed);
        if ((domed || !thin) && set.normals.empty()) form.casting = curveTriangles(set, own, true);
    }
    if (const PointSet& set = shape.points; !set.points.empty() && !set.points[0].empty())
        form.seen.mesh = pointTriangles(set, fineness);
    return form;
}

} // namespace patina

#include "hdDelegate/raster/rasterShapes.h"

#include "hdDelegate/scene/curveSegments.h"
#include "hdDelegate/scene/primvarEval.h"
#include "hdDelegate/scene/tangentFrames.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float twoPi = 6.2831853f;

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

/// Control points of a segment as a Bezier curve: where it is, and where it goes.
struct SegmentPoint {
    vec3 position, along;
    float radius;
};

SegmentPoint pointOf(const CurveSet& set, size_t segment, float u) {
    const auto& points = set.controlPoints[0];
    const uint32_t first = set.segments[segment];
    if (set.basis == CurveBasis::Linear) {
        const vec4 a = points[first], b = points[first + 1];
        const vec4 p = a * (1.0f - u) + b * u;
        return {vec3(p), vec3(b - a), p.w};
    }
    const vec4 p[4] = {points[first], points[first + 1], points[first + 2], points[first + 3]};
    vec4 b[4] = {p[0], p[1], p[2], p[3]};
    toBezier(set.basis, p, b);
    const float w = 1.0f - u;
    const vec4 at =
        b[0] * (w * w * w) + b[1] * (3 * w * w * u) + b[2] * (3 * w * u * u) + b[3] * (u * u * u);
    const vec4 d = (b[1] - b[0]) * (w * w) + (b[2] - b[1]) * (2 * w * u) + (b[3] - b[2]) * (u * u);
    return {vec3(at), vec3(d), at.w};
}

TriangleMesh curveTriangles(const CurveSet& set) {
    Builder out;
    const bool linear = set.basis == CurveBasis::Linear, ribbon = !set.normals.empty();
    const int steps = linear ? 1 : 8, sides = ribbon ? 1 : 8;
    for (const MeshAttribute& a : set.attributes) {
        MeshAttribute copy = a;
        if (a.rate == Rate::PerCorner) copy.data.clear();
        out.mesh.attributes.push_back(std::move(copy));
    }
    for (size_t s = 0; s < set.segments.size(); ++s) {
        const int element = s < set.segmentCurve.size() ? set.segmentCurve[s] : int(s);
        const int subset = s < set.segmentSubset.size() ? set.segmentSubset[s] : 0;
        std::vector<uint32_t> rings;
        for (int i = 0; i <= steps; ++i) {
            const float u = float(i) / float(steps);
            const SegmentPoint p = pointOf(set, s, u);
            const float length = glm::length(p.along);
            const vec3 t = length > 0.0f ? p.along / length : vec3(0, 0, 1);
            vec3 x, y;
            orthonormalBasis(t, x, y);
            if (ribbon) {
                const auto& normals = set.normals[0];
                const size_t k =
                    std::min<size_t>(set.segments[s] + (linear ? 0 : 1), normals.size() - 1);
                const size_t k1 = std::min(k + 1, normals.size() - 1);
                const vec3 n = normals[k] * (1.0f - u) + normals[k1] * u;
                const vec3 across = glm::cross(n, t);
                const float wide = glm::length(across);
                x = wide > 0.0f ? across / wide : x;
                const vec3 face = glm::normalize(glm::cross(t, x));
                rings.push_back(out.add(p.position - x * p.radius, face));
                out.add(p.position + x * p.radius, face);
                continue;
            }
            for (int k = 0; k < sides; ++k) {
                const float phi = twoPi * float(k) / float(sides);
                const vec3 n = x * std::cos(phi) + y * std::sin(phi);
                const uint32_t v = out.add(p.position + n * p.radius, n);
                if (k == 0) rings.push_back(v);
            }
        }
        const auto corner = [&](uint32_t, float u) {
            for (size_t a = 0; a < set.attributes.size(); ++a) {
                if (set.attributes[a].rate != Rate::PerCorner) continue;
                MeshAttribute& to = out.mesh.attributes[a];
                const MeshAttribute& from = set.attributes[a];
                const float* lo = &from.data[2 * s * size_t(from.components)];
                for (int c = 0; c < from.components; ++c)
                    to.data.push_back(lo[c] * (1.0f - u) + lo[from.components + c] * u);
            }
        };
        for (int i = 0; i < steps; ++i)
            for (int k = 0; k < sides; ++k) {
                const uint32_t next = uint32_t(ribbon ? 1 : (k + 1) % sides);
                const uint32_t a = rings[size_t(i)] + uint32_t(ribbon ? 0 : k);
                const uint32_t b = rings[size_t(i)] + next;
                const uint32_t c = rings[size_t(i) + 1] + uint32_t(ribbon ? 0 : k);
                const uint32_t d = rings[size_t(i) + 1] + next;
                const float u0 = float(i) / float(steps), u1 = float(i + 1) / float(steps);
                out.triangle(a, b, d, element, subset);
                corner(a, u0), corner(b, u0), corner(d, u1);
                out.triangle(a, d, c, element, subset);
                corner(a, u0), corner(d, u1), corner(c, u1);
            }
    }
    return out.finish();
}

TriangleMesh pointTriangles(const PointSet& set) {
    Builder out;
    for (const MeshAttribute& a : set.attributes) {
        MeshAttribute copy = a;
        if (a.rate == Rate::PerVertex) copy.data.clear();
        out.mesh.attributes.push_back(std::move(copy));
    }
    const bool discs = !set.normals.empty();
    const int rows = discs ? 1 : 8, columns = 16;
    for (size_t i = 0; i < set.points[0].size(); ++i) {
        const vec3 center = vec3(set.points[0][i]);
        const float radius = set.points[0][i].w;
        const int element = i < set.pointIndex.size() ? set.pointIndex[i] : int(i);
        const int subset = i < set.pointSubset.size() ? set.pointSubset[i] : 0;
        const size_t before = out.positions.size();
        if (discs) {
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

TriangleMesh rasterTriangles(const Geometry& prim, const TessellationOptions& options,
                             Diagnostics& diagnostics) {
    switch (prim.kind) {
    case GeometryKind::Mesh:
        return tessellate(static_cast<const Mesh&>(prim), options, diagnostics);
    case GeometryKind::Implicit:
        return tessellate(static_cast<const Implicit&>(prim), options, diagnostics);
    case GeometryKind::Curves: {
        const CurveSet set = buildCurves(static_cast<const Curves&>(prim), options, diagnostics);
        return set.segments.empty() ? TriangleMesh() : curveTriangles(set);
    }
    case GeometryKind::Points: {
        const PointSet set = buildPoints(static_cast<const Points&>(prim), options, diagnostics);
        return set.points.empty() || set.points[0].empty() ? TriangleMesh() : pointTriangles(set);
    }
    case GeometryKind::Volume: break;
    }
    return TriangleMesh();
}

} // namespace patina

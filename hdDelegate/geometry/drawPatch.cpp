// SPDX-License-Identifier: Apache-2.0
// NURBS patches as triangles: every vertex is on the surface and has its normal.

#include "hdDelegate/geometry/drawnFaces.h"
#include "hdDelegate/geometry/nurbs.h"
#include "hdDelegate/geometry/patchGrid.h"
#include "hdDelegate/geometry/trimLoops.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using dvec3 = glm::dvec3;
using Rate = MeshAttribute::Rate;

constexpr int maxPieces = 64;      // of a span, along one direction
constexpr int minCurvedPieces = 4; // of a span that may be curved

class PatchDrawer {
public:
    PatchDrawer(const Mesh& mesh, const PointSteps& points, std::vector<double> weights)
        : _mesh(mesh), _points(points), _weights(std::move(weights)), _u(mesh.patch->u),
          _v(mesh.patch->v), _stride(size_t(mesh.patch->u.vertexCount)) {}

    TriangleMesh draw(const TessellationOptions& options, Diagnostics& diagnostics) {
        chooseLines(options);
        const auto loops = trimLoops(options, diagnostics);
        const bool keepInside = _mesh.patch->trim.keepInside;
        _grid = loops.empty() ? wholeGrid(_u, _v) : trimmedGrid(_u, _v, loops, keepInside);
        TriangleMesh out;
        const size_t vertices = _grid.vertices.size();
        out.positions.resize(_points.steps.size());
        out.normals.resize(_points.steps.size());
        for (size_t step = 0; step < _points.steps.size(); ++step) {
            out.positions[step].reserve(vertices + 1); // Embree reads 16 bytes of the last point
            out.normals[step].reserve(vertices);
            placeVertices(_points.steps[step], out.positions[step], out.normals[step]);
        }
        addTriangles(out);
        addPrimvars(diagnostics, out);
        out.refineLevel = int(std::lround(std::log2(double(_pieces))));
        finish(diagnostics, out);
        return out;
    }

private:
    void chooseLines(const TessellationOptions& options) {
        std::vector<int> u = piecesOf(_u.basis, 1, _stride, _mesh.patch->v.vertexCount, options);
        std::vector<int> v = piecesOf(_v.basis, _stride, 1, int(_stride), options);
        const int floor = refineFloor(options);
        const auto sum = [](const std::vector<int>& list) {
            double all = 0.0;
            for (int n : list)
                all += n;
            return all;
        };
        // Too many: every span is cut half as often, down to the floor, then on to the budget.
        for (int minimum : {std::max(floor, minCurvedPieces), 1}) {
            const double budget =
                double(minimum > 1 ? std::min(options.edgeBudget, options.triangleBudget)
                                   : options.triangleBudget);
            for (int maximum = maxPieces; maximum > minimum && 2.0 * sum(u) * sum(v) > budget;) {
                maximum /= 2;
                for (auto* list : {&u, &v})
                    for (int& n : *list)
                        n = std::min(n, std::max(maximum, 1));
            }
        }
        _u.chooseLines(u);
        _v.chooseLines(v);
        for (const auto* list : {&u, &v})
            for (int n : *list)
                _pieces = std::max(_pieces, n);
    }

    std::vector<std::vector<glm::dvec2>> trimLoops(const TessellationOptions& options,
                                                   Diagnostics& diagnostics) const {
        TrimOptions trim;
        trim.low = {_u.basis.low(), _v.basis.low()};
        trim.high = {_u.basis.high(), _v.basis.high()};
        trim.pieces = std::max(refineFloor(options), minCurvedPieces);
        trim.longest = double(options.targetEdge);
        trim.budget = options.triangleBudget / 4;
        trim.place = [&](const glm::dvec2& at) {
            return place(_points.steps[0], _u.at(at.x), _v.at(at.y)).p;
        };
        return patina::trimLoops(_mesh.patch->trim, _mesh.path, trim, diagnostics);
    }

    /// Pieces of a span at least.
    int refineFloor(const TessellationOptions& options) const {
        return 1 << std::clamp(_mesh.refineLevel, 0, options.maxRefineLevel);
    }

    /// @param stride, across from one control point to the next along this direction and the other
    std::vector<int> piecesOf(const NurbsBasis& basis, size_t stride, size_t across, int rows,
                              const TessellationOptions& options) const {
        const int floor = refineFloor(options);
        const int minimum = basis.order() > 2 ? std::max(floor, minCurvedPieces) : floor;
        std::vector<int> pieces;
        for (const NurbsBasis::Span& span : basis.spans()) {
            double longest = 0.0;
            if (options.targetEdge > 0.0f)
                for (int row = 0; row < rows; ++row)
                    longest = std::max(
                        longest,
                        basis.longest(span, &_points.steps[0][size_t(row) * across], stride));
            int n = minimum;
            while (n < maxPieces && longest > double(n) * double(options.targetEdge))
                n *= 2;
            pieces.push_back(n);
        }
        return pieces;
    }

    /// A vertex's value, made from one value per control point, and its derivatives.
    /// @param add (index of control point, weight here, by u, by v)
    template <class Add>
    void combine(const PatchLine& u, const PatchLine& v, const Add& add) const {
        const int ou = _u.basis.order(), ov = _v.basis.order();
        double sum = 0.0, sumU = 0.0, sumV = 0.0;
        const auto each = [&](const auto& use) {
            for (int j = 0; j < ov; ++j) {
                const size_t row = size_t(v.span.knot - ov + 1 + j) * _stride;
                for (int i = 0; i < ou; ++i) {
                    const size_t point = row + size_t(u.span.knot - ou + 1 + i);
                    const double w = _weights.empty() ? 1.0 : _weights[point];
                    const size_t a = size_t(i), b = size_t(j);
                    use(point, w * u.values[a] * v.values[b], w * u.slopes[a] * v.values[b],
                        w * u.values[a] * v.slopes[b]);
                }
            }
        };
        if (_weights.empty()) {
            each(add);
            return;
        }
        each([&](size_t, double n, double nu, double nv) {
            sum += n;
            sumU += nu;
            sumV += nv;
        });
        each([&](size_t point, double n, double nu, double nv) {
            const double share = n / sum;
            add(point, share, (nu - share * sumU) / sum, (nv - share * sumV) / sum);
        });
    }

    struct Place {
        dvec3 p{0.0}, byU{0.0}, byV{0.0};
    };
    Place place(const std::vector<vec3>& points, const PatchLine& u, const PatchLine& v) const {
        Place at;
        combine(u, v, [&](size_t point, double n, double nu, double nv) {
            const dvec3 p(points[point]);
            at.p += n * p;
            at.byU += nu * p;
            at.byV += nv * p;
        });
        return at;
    }

    void placeVertices(const std::vector<vec3>& points, std::vector<vec3>& positions,
                       std::vector<vec3>& normals) const {
        dvec3 low(INFINITY), high(-INFINITY);
        for (const vec3& p : points) {
            low = glm::min(low, dvec3(p));
            high = glm::max(high, dvec3(p));
        }
        const double size = glm::length(high - low);
        const double flat =
            1e-8 * size * size /
            ((_u.basis.high() - _u.basis.low()) * (_v.basis.high() - _v.basis.low()));
        for (const uvec2& vertex : _grid.vertices) {
            const PatchLine &u = _u.lines[vertex.x], &v = _v.lines[vertex.y];
            const Place at = place(points, u, v);
            positions.push_back(vec3(at.p));
            dvec3 n = glm::cross(at.byU, at.byV);
            if (!(glm::length(n) > flat)) { // a pole: an edge that is one point
                const Place near = place(points, _u.inside(u), _v.inside(v));
                n = glm::cross(near.byU, near.byV);
            }
            const double length = glm::length(n);
            normals.push_back(length > 0.0 && std::isfinite(length) ? vec3(n / length)
                                                                    : vec3(0, 0, 1));
        }
    }

    void addTriangles(TriangleMesh& out) const {
        const auto& p = out.positions[0];
        for (const PatchFace& f : _grid.faces) {
            const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
                if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return; // at a pole
                out.triangles.push_back(_mesh.leftHanded ? uvec3(a, c, b) : uvec3(a, b, c));
                out.triangleFace.push_back(f.segment);
            };
            const auto squared = [&](uint32_t a, uint32_t b) {
                return glm::dot(p[b] - p[a], p[b] - p[a]);
            };
            if (!f.whole) {
                add(f.a, f.b, f.c);
            } else if (squared(f.a, f.d) <= squared(f.b, f.c)) {
                add(f.a, f.b, f.d);
                add(f.a, f.d, f.c);
            } else {
                add(f.a, f.b, f.c);
                add(f.b, f.d, f.c);
            }
        }
        if (_mesh.leftHanded)
            for (auto& step : out.normals)
                for (vec3& n : step)
                    n = -n;
    }

    void addPrimvars(Diagnostics& diagnostics, TriangleMesh& out) const {
        ElementCounts counts;
        const size_t nu = size_t(_u.basis.segments()), nv = size_t(_v.basis.segments());
        counts.uniform = nu * nv;
        counts.varying = counts.faceVarying = (nu + 1) * (nv + 1);
        counts.vertex = _stride * size_t(_mesh.patch->v.vertexCount);
        bool hasSt = false;
        for (const Primvar& primvar : _mesh.primvars) {
            if (primvar.name == "normals") continue; // the surface has its own
            MeshAttribute attribute;
            attribute.name = primvar.name;
            attribute.components = primvar.components;
            std::vector<float> values;
            if (!expandPrimvar(primvar, counts, _mesh.path, diagnostics, values)) continue;
            switch (primvar.interpolation) {
            case Interpolation::Constant:
            case Interpolation::Uniform:
                attribute.rate = primvar.interpolation == Interpolation::Constant ? Rate::Constant
                                                                                  : Rate::PerFace;
                attribute.data = std::move(values);
                break;
            case Interpolation::Varying:
            case Interpolation::FaceVarying:
                attribute.rate = Rate::PerVertex;
                varying(values, attribute);
                break;
            case Interpolation::Vertex:
                attribute.rate = Rate::PerVertex;
                vertex(values, attribute);
                break;
            }
            hasSt = hasSt || primvar.name == "st";
            out.attributes.push_back(std::move(attribute));
        }
        if (!hasSt) addSt(out);
    }

    void varying(const std::vector<float>& values, MeshAttribute& out) const {
        const size_t row = size_t(_u.basis.segments()) + 1, n = size_t(out.components);
        for (const uvec2& vertex : _grid.vertices) {
            const PatchLine &u = _u.lines[vertex.x], &v = _v.lines[vertex.y];
            const float x = float(_u.basis.along(u.span, u.t));
            const float y = float(_v.basis.along(v.span, v.t));
            const size_t corner =
                size_t(_v.basis.segment(v.span)) * row + size_t(_u.basis.segment(u.span));
            const float* a = &values[corner * n];
            const float* b = a + row * n;
            for (size_t k = 0; k < n; ++k)
                out.data.push_back((1.0f - y) * ((1.0f - x) * a[k] + x * a[n + k]) +
                                   y * ((1.0f - x) * b[k] + x * b[n + k]));
        }
    }

    void vertex(const std::vector<float>& values, MeshAttribute& out) const {
        const size_t n = size_t(out.components);
        double sum[16];
        for (const uvec2& vertex : _grid.vertices) {
            const PatchLine &u = _u.lines[vertex.x], &v = _v.lines[vertex.y];
            std::fill_n(sum, n, 0.0);
            combine(u, v, [&](size_t point, double weight, double, double) {
                for (size_t k = 0; k < n; ++k)
                    sum[k] += weight * double(values[point * n + k]);
            });
            out.data.insert(out.data.end(), sum, sum + n);
        }
    }

    void addSt(TriangleMesh& out) const {
        MeshAttribute st;
        st.name = "st";
        st.components = 2;
        st.rate = Rate::PerVertex;
        const auto across = [](const NurbsBasis& basis, double t) {
            return float((t - basis.low()) / (basis.high() - basis.low()));
        };
        for (const uvec2& vertex : _grid.vertices) {
            const PatchLine &u = _u.lines[vertex.x], &v = _v.lines[vertex.y];
            st.data.push_back(across(_u.basis, u.t));
            st.data.push_back(across(_v.basis, v.t));
        }
        out.attributes.push_back(std::move(st));
    }

    void finish(Diagnostics& diagnostics, TriangleMesh& out) const {
        const std::vector<uint16_t> subsetOf = subsetOfElements(
            _mesh, size_t(_u.basis.segments()) * size_t(_v.basis.segments()), diagnostics);
        if (!subsetOf.empty())
            for (int segment : out.triangleFace)
                out.triangleSubset.push_back(subsetOf[size_t(segment)]);
        growBounds(out);
    }

    const Mesh& _mesh;
    const PointSteps& _points;
    std::vector<double> _weights;
    PatchDirection _u, _v;
    PatchGrid _grid;
    size_t _stride;
    int _pieces = 1;
};

} // namespace

TriangleMesh drawPatch(const Mesh& mesh, const PointSteps& points,
                       const TessellationOptions& options, Diagnostics& diagnostics) {
    const NurbsPatch& patch = *mesh.patch;
    TriangleMesh nothing;
    nothing.positions = points.steps;
    for (const auto& problem :
         {NurbsBasis::problem(patch.u, "u"), NurbsBasis::problem(patch.v, "v")})
        if (problem) {
            diagnostics.warn(mesh.path, problem.input, messages::patchNotDrawn(problem.message));
            return nothing;
        }
    const size_t needed = size_t(patch.u.vertexCount) * size_t(patch.v.vertexCount);
    if (points.count() != needed) {
        diagnostics.warn(
            mesh.path, "points",
            messages::patchPointCount(points.count(), patch.u.vertexCount, patch.v.vertexCount));
        return nothing;
    }
    if (!points.bad.empty()) {
        diagnostics.warn(mesh.path, "points", messages::patchPointsNotFinite);
        return nothing;
    }
    PatchDrawer drawer(mesh, points, usableWeights(patch.weights, needed, mesh.path, diagnostics));
    TriangleMesh out = drawer.draw(options, diagnostics);
    for (const auto& step : out.positions)
        for (const vec3& p : step)
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                diagnostics.warn(mesh.path, "points", messages::patchNotFinite);
                return nothing;
            }
    return out;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/curveSegments.h"
#include "hdDelegate/geometry/tangentFrames.h"
#include "hdDelegate/raster/scene/rasterShapes.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {
constexpr int maxSides = 63, maxSteps = 64;
constexpr float largestTurn = 0.15f; ///< of a curve's direction or a ribbon's normal in a step

using Rate = MeshAttribute::Rate;

/// A place on a segment. Its ends are round where a linear curve has them.
struct Ring {
    vec3 position, along; ///< `along` of unit length
    float radius;
    float u;    ///< of attributes
    float lean; ///< sine of the normal's angle to the circle's plane
    StripEnd end = StripGoesOn;
};

float widestOf(const CurveSet& set) {
    float widest = 0.0f;
    for (const vec4& p : set.controlPoints[0])
        widest = std::max(widest, p.w);
    return widest;
}

class CurveBuilder {
public:
    CurveBuilder(const CurveSet& set, const RasterFineness& fineness, bool strips, bool domed)
        : _set(set), _gap(fineness.gap), _linear(set.basis == CurveBasis::Linear),
          _ribbon(!set.normals.empty()), _strips(strips && !_ribbon), _domed(domed && _strips) {
        for (const MeshAttribute& a : set.attributes) {
            MeshAttribute copy = a;
            if (valuesOfSegment(a.rate) > 0) {
                copy.data.clear();
                copy.rate = Rate::PerCorner;
            }
            _fewestSteps = std::max(_fewestSteps, valuesOfSegment(a.rate) == 4 ? 4 : 1);
            _out.mesh.attributes.push_back(std::move(copy));
        }
    }

    RasterTriangles build() {
        const float widest = widestOf(_set);
        _sides = _domed ? 3 : _strips || _ribbon ? 1 : sidesFor(widest);
        // As wide as the circle in the mean over all directions.
        _wider = !_strips && _sides > 1 ? pi / float(_sides) / std::sin(pi / float(_sides)) : 1.0f;
        for (size_t s = 0; s < _set.segments.size(); ++s)
            segment(s);
        TriangleMesh& mesh = _out.mesh;
        mesh.boundsMin = vec3(INFINITY);
        mesh.boundsMax = vec3(-INFINITY);
        for (size_t i = 0; i < _positions.size(); ++i) {
            const float r = _strips ? std::fabs(_out.halfWidth[i]) : 0.0f;
            mesh.boundsMin = glm::min(mesh.boundsMin, _positions[i] - r);
            mesh.boundsMax = glm::max(mesh.boundsMax, _positions[i] + r);
        }
        mesh.positions = {std::move(_positions)};
        mesh.normals = {std::move(_normals)};
        return std::move(_out);
    }

    size_t expected() const {
        size_t steps = 0;
        for (size_t s = 0; s < _set.segments.size(); ++s)
            steps += size_t(stepsOf(s));
        return 2 * steps * size_t(_domed ? 3 : _strips || _ribbon ? 1 : sidesFor(widestOf(_set)));
    }

private:
    /// An odd number: the width of such polygons depends less on the direction.
    int sidesFor(float radius) const {
        if (!(_gap > 0.0f)) return 9;
        return std::clamp(int(std::ceil(pi * std::sqrt(radius / (3.0f * _gap)))) | 1, 5, maxSides);
    }

    int controls() const { return _linear ? 2 : 4; }
    vec4 control(size_t s, int k) const {
        return _set.controlPoints[0][_set.segments[s] + size_t(k)];
    }
    Ring ringAt(size_t s, float u) const {
        const vec4 weights = basisWeights(_set.basis, u), slopes = basisSlopes(_set.basis, u);
        vec4 at(0.0f), step(0.0f);
        for (int k = 0; k < controls(); ++k) {
            at += weights[k] * control(s, k);
            step += slopes[k] * control(s, k);
        }
        const float length = glm::length(vec3(step));
        const vec3 along = length > 0.0f ? vec3(step) / length : vec3(0, 0, 1);
        return {vec3(at), along, std::max(at.w, 0.0f), u, leanOf(step.w, length)};
    }
    /// Embree's linear curves are cones that touch the spheres of both ends, its others circles
    /// that are swept. @param widens how much, over the length
    float leanOf(float widens, float length) const {
        const float slope = widens / length;
        if (!std::isfinite(slope)) return 0.0f;
        return _linear ? std::clamp(-slope, -0.99f, 0.99f) : -slope / std::hypot(1.0f, slope);
    }
    /// The first or the last ring before a cap.
    Ring edgeOf(size_t s, float u) const {
        Ring ring = ringAt(s, u);
        if (!_linear) return ring;
        const float c = std::sqrt(1.0f - ring.lean * ring.lean);
        if (isRound(s, u > 0.0f)) {
            ring.position += ring.along * (ring.lean * ring.radius);
            ring.radius *= c; // where cone and sphere touch
        } else {
            ring.radius /= c;
        }
        return ring;
    }
    /// As Embree's normal oriented curves: mixed as the points are.
    vec3 ribbonNormal(size_t s, float u) const {
        const auto& normals = _set.normals[0];
        const vec4 weights = basisWeights(_set.basis, u);
        vec3 n(0.0f);
        for (int k = 0; k < controls(); ++k)
            n += weights[k] * normals[std::min(_set.segments[s] + size_t(k), normals.size() - 1)];
        const float length = glm::length(n);
        return length > 0.0f ? n / length : vec3(0, 0, 1);
    }

    /// From the middle of a ribbon to its edge.
    vec3 acrossRibbon(size_t s, const Ring& ring) const {
        vec3 across = glm::cross(ribbonNormal(s, ring.u), ring.along), other;
        const float length = glm::length(across);
        if (length > 0.0f)
            across /= length;
        else
            orthonormalBasis(ring.along, across, other);
        return across * ring.radius;
    }

    /// Steps so that no chord leaves the segment by more than the gap, nor turns by much.
    int stepsOf(size_t s) const {
        if (_linear) return 1;
        if (!(_gap > 0.0f)) return 8;
        const vec4 in[4] = {control(s, 0), control(s, 1), control(s, 2), control(s, 3)};
        vec4 b[4] = {in[0], in[1], in[2], in[3]};
        toBezier(_set.basis, in, b);
        const float bend = 6.0f * std::max(glm::length(b[0] - 2.0f * b[1] + b[2]),
                                           glm::length(b[1] - 2.0f * b[2] + b[3]));
        float turn = 0.0f;
        constexpr int parts = 4;
        vec3 along = ringAt(s, 0.0f).along, normal = _ribbon ? ribbonNormal(s, 0.0f) : along;
        for (int i = 1; i <= parts; ++i) {
            const float u = float(i) / float(parts);
            const vec3 next = ringAt(s, u).along, nextNormal = _ribbon ? ribbonNormal(s, u) : next;
            turn += std::max(glm::length(next - along), glm::length(nextNormal - normal));
            along = next;
            normal = nextNormal;
        }
        const float steps = std::max(std::sqrt(bend / (8.0f * _gap)), turn / largestTurn);
        // Points near the largest float make a bend that is no number: the fewest steps then.
        return int(std::ceil(std::min(std::max(float(_fewestSteps), steps), float(maxSteps))));
    }

    /// Whether no other segment of the curve goes on from an end of this one.
    bool isOpen(size_t s, bool end) const {
        const auto curve = [&](size_t k) {
            return k < _set.segmentCurve.size() ? _set.segmentCurve[k] : int(k);
        };
        const Ring edge = ringAt(s, end ? 1.0f : 0.0f);
        const auto goesOn = [&](size_t k) {
            const vec3 gap = ringAt(k, end ? 0.0f : 1.0f).position - edge.position;
            return glm::length(gap) <= 1e-3f * edge.radius;
        };
        const size_t next = end ? s + 1 : s - 1; // wraps around to what is no segment
        if (next < _set.segments.size() && curve(next) == curve(s)) return !goesOn(next);
        // A periodic curve meets its other end.
        size_t other = s;
        while (end ? other > 0 && curve(other - 1) == curve(s)
                   : other + 1 < _set.segments.size() && curve(other + 1) == curve(s))
            other += end ? size_t(-1) : 1;
        return !goesOn(other);
    }
    /// Whether a linear segment's end at u shows a sphere.
    bool isRound(size_t s, bool end) const {
        if (!_linear || !(_gap > 0.0f)) return false;
        const float radius = control(s, end ? 1 : 0).w;
        if (radius <= 2.0f * _gap) return false;
        const size_t other = end ? s + 1 : s - 1; // wraps around to what is no segment
        if (other >= _set.segments.size() ||
            _set.segments[end ? other : s] != _set.segments[end ? s : other] + 1)
            return true;
        const vec3 a = ringAt(s, 0.0f).along, b = ringAt(other, 0.0f).along;
        return radius * glm::length(a - b) > 2.0f * _gap;
    }
    void addCap(size_t s, bool end, std::vector<Ring>& rings) const {
        const Ring edge = ringAt(s, end ? 1.0f : 0.0f);
        const int steps = _strips ? 3 : std::max(2, (_sides + 2) / 4);
        const float begin = std::asin(edge.lean), pole = end ? 0.5f * pi : -0.5f * pi;
        for (int i = 1; i <= steps; ++i) {
            const float part = float(end ? i : steps + 1 - i) / float(steps);
            const float angle = begin + (pole - begin) * part;
            Ring ring = edge;
            ring.lean = std::sin(angle);
            ring.position += edge.along * (ring.lean * edge.radius);
            ring.radius *= std::max(std::cos(angle), 0.0f);
            rings.push_back(ring);
        }
    }

    uint32_t vertex(const vec3& position, const vec3& normal) {
        _positions.push_back(position);
        _normals.push_back(normal);
        return uint32_t(_positions.size()) - 1;
    }
    /// @returns the first vertex of the ring
    uint32_t addVertices(size_t s, const Ring& ring) {
        if (_strips) {
            for (int k = 0; k <= _sides; ++k) {
                const bool edge = k == 0 || k == _sides;
                _out.halfWidth.push_back(2 * k < _sides ? ring.radius : -ring.radius);
                _out.ends.push_back(float(ring.end) + (edge ? 0.0f : StripDome));
                vertex(ring.position, ring.along);
            }
            return uint32_t(_positions.size()) - uint32_t(_sides) - 1;
        }
        if (_ribbon) {
            const vec3 wide = acrossRibbon(s, ring);
            for (const float side : {-1.0f, 1.0f}) {
                // Where a ribbon twists, its edges go other ways than its middle.
                const float step = ring.u < 0.5f ? 1e-2f : -1e-2f;
                const Ring next = ringAt(s, ring.u + step);
                const vec3 edge = ring.position + wide * side;
                const vec3 along = (next.position + acrossRibbon(s, next) * side - edge) / step;
                const vec3 face = glm::cross(along, wide);
                vertex(edge,
                       glm::length(face) > 0.0f ? glm::normalize(face) : ribbonNormal(s, ring.u));
            }
            return uint32_t(_positions.size()) - 2;
        }
        // Turned no more than the curve itself from ring to ring, so that tubes are not twisted.
        vec3 x = _x - ring.along * glm::dot(_x, ring.along), y;
        if (glm::length(x) > 0.1f)
            x = glm::normalize(x);
        else
            orthonormalBasis(ring.along, x, y);
        y = glm::cross(ring.along, x);
        _x = x;
        const float flat = std::sqrt(std::max(0.0f, 1.0f - ring.lean * ring.lean));
        for (int k = 0; k < _sides; ++k) {
            const float phi = 2.0f * pi * float(k) / float(_sides);
            const vec3 n = x * std::cos(phi) + y * std::sin(phi);
            vertex(ring.position + n * (ring.radius * _wider), n * flat + ring.along * ring.lean);
        }
        return uint32_t(_positions.size()) - uint32_t(_sides);
    }
    void corner(size_t s, float u) {
        for (size_t a = 0; a < _set.attributes.size(); ++a) {
            const MeshAttribute& from = _set.attributes[a];
            const int values = valuesOfSegment(from.rate);
            const vec4 weights = valueWeights(from.rate, u);
            for (int c = 0; c < from.components && values > 0; ++c) {
                float value = 0.0f;
                for (int k = 0; k < values; ++k)
                    value += weights[k] *
                             from.data[(size_t(values) * s + size_t(k)) * size_t(from.components) +
                                       size_t(c)];
                _out.mesh.attributes[a].data.push_back(value);
            }
        }
    }
    /// @param lean as of Ring
    void triangle(size_t s, const uint32_t v[3], const float u[3], const vec3& along, float lean) {
        TriangleMesh& mesh = _out.mesh;
        mesh.triangles.emplace_back(v[0], v[1], v[2]);
        mesh.triangleFace.push_back(s < _set.segmentCurve.size() ? _set.segmentCurve[s] : int(s));
        mesh.triangleSubset.push_back(s < _set.segmentSubset.size() ? _set.segmentSubset[s] : 0);
        _out.along.push_back(along);
        _out.slope.push_back(-lean / std::sqrt(std::max(1.0f - lean * lean, 1e-6f)));
        for (int k = 0; k < 3; ++k)
            corner(s, u[k]);
    }
    void segment(size_t s) {
        std::vector<Ring> rings;
        if (isRound(s, false)) addCap(s, false, rings);
        const int steps = stepsOf(s);
        for (int i = 0; i <= steps; ++i)
            rings.push_back(edgeOf(s, float(i) / float(steps)));
        // Where caps are drawn there is nothing to make longer.
        if (_strips && !isRound(s, false) && isOpen(s, false))
            rings.front().end = _linear ? StripBeginsRound : StripBegins;
        if (_strips && !isRound(s, true) && isOpen(s, true))
            rings.back().end = _linear ? StripEndsRound : StripEnds;
        if (isRound(s, true)) addCap(s, true, rings);
        std::vector<uint32_t> first;
        _x = vec3(0.0f);
        for (const Ring& ring : rings)
            first.push_back(addVertices(s, ring));
        const bool open = _strips || _ribbon;
        for (size_t i = 0; i + 1 < rings.size(); ++i) {
            const vec3 middle = rings[i].along + rings[i + 1].along;
            const float length = std::max(glm::length(middle), 1e-6f);
            const float radius = std::max(0.5f * (rings[i].radius + rings[i + 1].radius), 1e-20f);
            const vec3 along = middle * (radius / length);
            const float lean = 0.5f * (rings[i].lean + rings[i + 1].lean);
            for (int k = 0; k < _sides; ++k) {
                const uint32_t own = uint32_t(k), next = uint32_t(open ? k + 1 : (k + 1) % _sides);
                const uint32_t a = first[i] + own, b = first[i] + next;
                const uint32_t c = first[i + 1] + own, d = first[i + 1] + next;
                const float u0 = rings[i].u, u1 = rings[i + 1].u;
                const uint32_t v0[3] = {a, b, d}, v1[3] = {a, d, c};
                const float p0[3] = {u0, u0, u1}, p1[3] = {u0, u1, u1};
                triangle(s, v0, p0, along, lean);
                triangle(s, v1, p1, along, lean);
            }
        }
    }

    const CurveSet& _set;
    float _gap, _wider = 1.0f;
    bool _linear, _ribbon, _strips, _domed;
    int _sides = 1, _fewestSteps = 1;
    vec3 _x{0.0f}; ///< across the ring before
    RasterTriangles _out;
    std::vector<vec3> _positions, _normals;
};

} // namespace

bool fitCurves(const CurveSet& set, RasterFineness& fineness, size_t maximum) {
    const float widest = widestOf(set);
    for (int i = 0; i < 24 && fineness.gap > 0.0f; ++i) {
        const bool thin = widest <= fineness.thick;
        if (CurveBuilder(set, fineness, thin, false).expected() <= maximum) break;
        fineness.gap *= 2.0f;
        fineness.thick *= 2.0f;
    }
    return widest <= fineness.thick;
}

bool domedStripsFit(const CurveSet& set, const RasterFineness& fineness, size_t maximum) {
    return CurveBuilder(set, fineness, true, true).expected() <= maximum;
}

RasterTriangles curveTriangles(const CurveSet& set, const RasterFineness& fineness, bool strips,
                               bool domed) {
    return CurveBuilder(set, fineness, strips, domed).build();
}

} // namespace patina

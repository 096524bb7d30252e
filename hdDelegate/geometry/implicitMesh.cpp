// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/drawnFaces.h"
#include "hdDelegate/geometry/implicitFaces.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace patina {

namespace {

using Rate = MeshAttribute::Rate;

constexpr int aroundSegments = roundSegments;
constexpr int sphereRings = 64;                      // from pole to pole
constexpr int byFacesAround = 16 * shapeFacesAround; // as many on each of OpenUSD's faces
constexpr int byFacesRings = 8 * sphereFaceRows;
// Over a flat quad, since two triangles do not interpolate its corners; odd, and so never coarser.
constexpr int byFacesAcross = 7;

/// Cosine and sine of s turns, exactly the same at 0 and 1 so that the seam closes.
vec2 turn(float s) {
    const float phi = s < 1.0f ? glm::two_pi<float>() * s : 0.0f;
    return vec2(std::cos(phi), std::sin(phi));
}

/// The part of OpenUSD's faces that a side of a shape covers.
struct FaceGrid {
    int first, columns, rows;
};

/// Builds a mesh in the frame whose z is the prim's axis. Vertices of different sides are never
/// shared, so one normal and st per vertex is enough.
class ShapeBuilder {
public:
    /// @param coarser divides the numbers of segments: 1, 2, 4 or 8. Faces keep their numbers.
    /// @param byFaces makes segments that end where OpenUSD's faces do, and counts those
    ShapeBuilder(TriangleMesh& out, int coarser, bool byFaces)
        : _out(out), _coarser(coarser), _byFaces(byFaces) {
        // Outlines of inscribed polygons would be too narrow.
        const float half = glm::pi<float>() * float(coarser) / float(around());
        if (coarser > 1) _wider = half / std::sin(half);
        _out.positions.resize(1);
        _out.normals.resize(1);
        _st.name = "st";
        _st.components = 2;
        _st.rate = Rate::PerVertex;
    }

    /// A grid of (columns + 1) by (rows + 1) vertices from a function of (s, t) in 0..1 that gives
    /// position and normal. dP/ds x dP/dt points out. Each cell is a face.
    /// @param tRange part of the prim's t that the grid covers
    template <class F> void grid(int columns, int rows, const FaceGrid& faces, const F& surface,
                                 vec2 tRange = vec2(0.0f, 1.0f)) {
        const uint32_t first = uint32_t(_out.positions[0].size());
        const int across = columns % _coarser ? 1 : _coarser, up = rows % _coarser ? 1 : _coarser;
        const uint32_t step = uint32_t(columns / across + 1);
        for (int j = 0; j <= rows; j += up)
            for (int i = 0; i <= columns; i += across) {
                const vec2 st(float(i) / float(columns), float(j) / float(rows));
                vec3 position, normal;
                surface(st, position, normal);
                vertex(position, normal, vec2(st.x, glm::mix(tRange.x, tRange.y, st.y)));
            }
        for (int j = 0; j < rows; j += up)
            for (int i = 0; i < columns; i += across) {
                const uint32_t a = first + uint32_t(j / up) * step + uint32_t(i / across);
                const uint32_t c = a + step;
                const int u = i * faces.columns / columns, v = j * faces.rows / rows;
                const int face =
                    _byFaces ? faces.first + v * faces.columns + u : _faces + j * columns + i;
                const auto at = [&](int du, int dv) {
                    const int s = i + du * across, t = j + dv * up;
                    return vec2(float(s * faces.columns) / float(columns) - float(u),
                                float(t * faces.rows) / float(rows) - float(v));
                };
                triangle(a, a + 1, c + 1, face, {at(0, 0), at(1, 0), at(1, 1)});
                triangle(a, c + 1, c, face, {at(0, 0), at(1, 1), at(0, 1)});
            }
        _faces += columns * rows;
    }

    /// A flat disk across the axis, whose rim has exactly the points of the sides that it closes.
    /// @param side +1 faces up, -1 down
    /// @param first number of the first of OpenUSD's faces
    void disk(float radius, float z, float side, int first) {
        if (!(radius > 0.0f)) return;
        const uint32_t centre = uint32_t(_out.positions[0].size());
        const vec3 normal(0, 0, side);
        vertex(vec3(0, 0, z), normal, vec2(0.5f));
        for (int i = 0; i < around(); i += _coarser) {
            const vec2 rim = turn(float(i) / float(around()));
            vertex(vec3(radius * _wider * rim, z), normal, 0.5f + 0.5f * vec2(side * rim.x, rim.y));
        }
        const uint32_t segments = uint32_t(around() / _coarser);
        for (uint32_t i = 0; i < segments; ++i) {
            const uint32_t a = centre + 1 + i, b = centre + 1 + (i + 1) % segments;
            const int column = int(i) * shapeFacesAround / int(segments);
            const auto at = [&](uint32_t rim) {
                return float(rim * shapeFacesAround) / float(segments) - float(column);
            };
            const int face = _byFaces ? first + column : _faces;
            const float v = side > 0.0f ? 0.0f : 1.0f; // of the rim
            const vec2 tip(0.5f, 1.0f - v), here(at(i), v), next(at(i + 1), v);
            if (side > 0.0f)
                triangle(centre, a, b, face, {tip, here, next});
            else
                triangle(centre, b, a, face, {tip, next, here});
        }
        ++_faces;
    }

    /// Turns z into the prim's axis, as UsdGeom does: by a rotation of the axes.
    void finish(int axis) {
        if (axis == 0 || axis == 1)
            for (auto* list : {&_out.positions[0], &_out.normals[0]})
                for (vec3& v : *list)
                    v = axis == 0 ? vec3(v.z, v.x, v.y) : vec3(v.y, v.z, v.x);
        _out.normalRate = Rate::PerVertex;
        _out.attributes.push_back(std::move(_st));
        trim();
        if (_out.triangles.empty()) return;
        _out.boundsMin = vec3(INFINITY);
        _out.boundsMax = vec3(-INFINITY);
        for (const vec3& p : _out.positions[0]) {
            _out.boundsMin = glm::min(_out.boundsMin, p);
            _out.boundsMax = glm::max(_out.boundsMax, p);
        }
    }

    int around() const { return _byFaces ? byFacesAround : aroundSegments; }
    int rings() const { return _byFaces ? byFacesRings : sphereRings; }
    int across() const { return _byFaces ? byFacesAcross : 1; }
    /// Of OpenUSD's faces; three per triangle where those are counted, else none.
    std::vector<FacePlace>& places() { return _places; }
    /// How much further from the axis coarse shapes are, to be as wide as round ones in the mean
    /// over all directions.
    float wider() const { return _wider; }
    void setWider(float factor) { _wider = factor; }
    int coarser() const { return _coarser; }

private:
    /// Thousands of prims are kept without the room that vectors grow in.
    void trim() {
        std::vector<vec3> exact;
        exact.reserve(_out.positions[0].size() + 1); // Embree reads 16 bytes
        exact.assign(_out.positions[0].begin(), _out.positions[0].end());
        _out.positions[0] = std::move(exact);
        _out.normals[0].shrink_to_fit();
        _out.triangles.shrink_to_fit();
        _out.triangleFace.shrink_to_fit();
        _out.attributes.back().data.shrink_to_fit();
    }
    void vertex(const vec3& position, const vec3& normal, const vec2& st) {
        _out.positions[0].push_back(position);
        _out.normals[0].push_back(normal);
        _st.data.push_back(st.x);
        _st.data.push_back(st.y);
    }
    void triangle(uint32_t a, uint32_t b, uint32_t c, int face, const std::array<vec2, 3>& at) {
        const auto& p = _out.positions[0];
        if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return; // at a pole
        _out.triangles.push_back(uvec3(a, b, c));
        _out.triangleFace.push_back(face);
        if (!_byFaces) return;
        for (const vec2& place : at)
            _places.push_back({face, place});
    }

    TriangleMesh& _out;
    MeshAttribute _st;
    std::vector<FacePlace> _places;
    int _faces = 0, _coarser;
    bool _byFaces;
    float _wider = 1.0f;
};

/// Part of a sphere between two latitudes (radians).
void sphereZone(ShapeBuilder& shape, float radius, float z, float from, float to, int rings,
                const FaceGrid& faces, vec2 tRange = vec2(0.0f, 1.0f)) {
    const auto zone = [&](const vec2& st, vec3& position, vec3& normal) {
        const float theta = from + (to - from) * st.y;
        const bool pole = std::abs(std::abs(theta) - glm::half_pi<float>()) < 1e-6f;
        const float ring = pole ? 0.0f : std::cos(theta);
        normal = vec3(ring * turn(st.x), pole ? std::copysign(1.0f, theta) : std::sin(theta));
        position = radius * shape.wider() * normal + vec3(0, 0, z);
    };
    shape.grid(shape.around(), rings, faces, zone, tRange);
}

/// How much larger an inscribed sphere of so many segments is to be for its outline to be as large
/// as a sphere's in the mean over all directions: a quarter of its surface (Cauchy 1832).
float largerSphere(int around) {
    const float pole = glm::half_pi<float>(), step = glm::two_pi<float>() / float(around);
    const auto at = [&](float theta, float phi) {
        return vec3(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                    std::sin(theta));
    };
    float area = 0.0f;
    for (int j = 0; j < around / 2; ++j) {
        const float low = -pole + step * float(j), high = low + step;
        const vec3 a = at(low, 0.0f), b = at(low, step), c = at(high, step), d = at(high, 0.0f);
        area +=
            0.5f * (glm::length(glm::cross(b - a, c - a)) + glm::length(glm::cross(c - a, d - a)));
    }
    return std::sqrt(4.0f * glm::pi<float>() / (float(around) * area));
}

/// The side of a cone, cylinder or truncated cone.
void side(ShapeBuilder& shape, float bottom, float top, float height, int firstFace,
          vec2 tRange = vec2(0.0f, 1.0f)) {
    if (height == 0.0f && bottom == top) return;
    // A cone needs rows: near the tip its normals turn quickly.
    const int rows = bottom == top ? 1 : 16;
    const vec2 slope = glm::normalize(vec2(height, bottom - top));
    const auto surface = [&](const vec2& st, vec3& position, vec3& normal) {
        const vec2 around = turn(st.x);
        const float radius = (bottom * (1.0f - st.y) + top * st.y) * shape.wider();
        position = vec3(radius * around, height * (st.y - 0.5f));
        normal = vec3(slope.x * around, slope.y);
    };
    shape.grid(shape.around(), rows, {firstFace, shapeFacesAround, 1}, surface, tRange);
}

/// Half a sphere at each end of a side; t follows the length of the profile.
void capsule(ShapeBuilder& shape, float bottom, float top, float height) {
    constexpr int around = shapeFacesAround, rings = sphereRings / 2;
    const float pole = glm::half_pi<float>();
    const float sideLength = glm::length(vec2(height, bottom - top));
    const float length = pole * (bottom + top) + sideLength;
    const float t1 = pole * bottom / length, t2 = (pole * bottom + sideLength) / length;
    if (bottom > 0.0f)
        sphereZone(shape, bottom, -0.5f * height, -pole, 0.0f, rings, {0, around, capFaceRows},
                   vec2(0.0f, t1));
    if (height > 0.0f && bottom + top > 0.0f)
        side(shape, bottom, top, height, capFaceRows * around, vec2(t1, t2));
    if (top > 0.0f)
        sphereZone(shape, top, 0.5f * height, 0.0f, pole, rings,
                   {(capFaceRows + 1) * around, around, capFaceRows}, vec2(t2, 1.0f));
}

/// Six faces, each with its own st.
void cube(ShapeBuilder& shape, float size) {
    if (!(size > 0.0f)) return;
    for (int axis = 0; axis < 3; ++axis)
        for (float sign : {1.0f, -1.0f}) {
            vec3 n(0.0f), u(0.0f), v(0.0f);
            n[axis] = sign;
            u[(axis + 1) % 3] = sign;
            v[(axis + 2) % 3] = 1.0f;
            const int face = 2 * (2 - axis) + (sign < 0.0f); // z first
            const auto side = [&](const vec2& st, vec3& position, vec3& normal) {
                position = 0.5f * size * (n + (2.0f * st.x - 1.0f) * u + (2.0f * st.y - 1.0f) * v);
                normal = n;
            };
            shape.grid(shape.across(), shape.across(), {face, 1, 1}, side);
        }
}

float checked(float value, const char* input, const Implicit& prim, Diagnostics& diagnostics) {
    if (std::isfinite(value) && value >= 0.0f) return value;
    diagnostics.warn(prim.path, input, messages::sizeNegative);
    return 0.0f;
}

} // namespace

int roundCoarseness(const Implicit& prim, float roundEdge) {
    if (!(roundEdge > 0.0f)) return 1;
    const float radius = std::max(prim.radius, prim.radiusTop);
    const float segment = glm::two_pi<float>() * radius / float(aroundSegments);
    int coarser = 1;
    while (coarser < 8 && segment * float(2 * coarser) <= roundEdge)
        coarser *= 2;
    return coarser;
}

float roundEdgeOf(float radius, int coarser) {
    return 1.01f * float(coarser) * glm::two_pi<float>() * radius / float(aroundSegments);
}

TriangleMesh tessellate(const Implicit& implicit, const TessellationOptions& options,
                        Diagnostics& diagnostics) {
    TriangleMesh out;
    const bool byFaces = countsFaces(implicit);
    ShapeBuilder shape(out, roundCoarseness(implicit, options.roundEdge), byFaces);
    const auto size = [&](float value, const char* input) {
        return checked(value, input, implicit, diagnostics);
    };
    const auto topRadius = [&](float bottom) {
        return implicit.radiusTop < 0.0f ? bottom : size(implicit.radiusTop, "radiusTop");
    };
    int axis = implicit.axis;
    if (axis < 0 || axis > 2) {
        diagnostics.warn(implicit.path, "axis", messages::axisUnknown);
        axis = 2;
    }
    switch (implicit.shape) {
    case ImplicitShape::Sphere: {
        const float radius = size(implicit.radius, "radius");
        if (shape.coarser() > 1) shape.setWider(largerSphere(shape.around() / shape.coarser()));
        if (radius > 0.0f)
            sphereZone(shape, radius, 0.0f, -glm::half_pi<float>(), glm::half_pi<float>(),
                       shape.rings(), {0, shapeFacesAround, sphereFaceRows});
        axis = 2;
        break;
    }
    case ImplicitShape::Cube:
        cube(shape, size(implicit.size, "size"));
        axis = 2;
        break;
    case ImplicitShape::Cone: {
        const float radius = size(implicit.radius, "radius");
        const float height = size(implicit.height, "height");
        side(shape, radius, 0.0f, height, shapeFacesAround);
        shape.disk(radius, -0.5f * height, -1.0f, 0);
        break;
    }
    case ImplicitShape::Cylinder: {
        const float radius = size(implicit.radius, "radius"), top = topRadius(radius);
        const float height = size(implicit.height, "height");
        side(shape, radius, top, height, shapeFacesAround);
        shape.disk(radius, -0.5f * height, -1.0f, 0);
        shape.disk(top, 0.5f * height, 1.0f, 2 * shapeFacesAround);
        break;
    }
    case ImplicitShape::Capsule: {
        const float radius = size(implicit.radius, "radius");
        capsule(shape, radius, topRadius(radius), size(implicit.height, "height"));
        break;
    }
    case ImplicitShape::Plane: {
        const float width = size(implicit.width, "width"), length = size(implicit.length, "length");
        // UsdGeomPlane: width along x, length along y about z; y and z about x; x and z about y.
        const vec2 extent = axis == 2 ? vec2(width, length) : vec2(length, width);
        const auto plane = [&](const vec2& st, vec3& position, vec3& normal) {
            position = vec3(extent * (st - 0.5f), 0.0f);
            normal = vec3(0, 0, 1);
        };
        if (width > 0.0f && length > 0.0f)
            shape.grid(shape.across(), shape.across(), {0, 1, 1}, plane);
        break;
    }
    }
    shape.finish(axis);
    if (implicit.leftHanded) {
        for (uvec3& t : out.triangles)
            std::swap(t.y, t.z);
        for (size_t i = 0; i < shape.places().size(); i += 3)
            std::swap(shape.places()[i + 1], shape.places()[i + 2]);
        for (vec3& n : out.normals[0])
            n = -n;
    }
    const ShapeFaces faces = byFaces ? facesOf(implicit) : ShapeFaces();
    for (const Primvar& primvar : implicit.primvars) {
        if (primvar.name == "normals") continue;
        MeshAttribute attribute;
        const bool one = !byFaces || primvar.interpolation == Interpolation::Constant;
        if (!(one ? expandConstant(primvar, implicit.path, diagnostics, attribute)
                  : expandOnFaces(primvar, faces, out, shape.places(), implicit.path, diagnostics,
                                  attribute)))
            continue;
        if (primvar.name == "st")
            out.attributes.front() = std::move(attribute);
        else
            out.attributes.push_back(std::move(attribute));
    }
    const std::vector<uint16_t> subsetOf =
        subsetOfElements(implicit, byFaces ? faces.counts.uniform : 0, diagnostics);
    if (!subsetOf.empty())
        for (int face : out.triangleFace)
            out.triangleSubset.push_back(subsetOf[face]);
    return out;
}

} // namespace patina

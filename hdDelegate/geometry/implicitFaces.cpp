// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/implicitFaces.h"

#include <algorithm>

namespace patina {

namespace {

using Rate = MeshAttribute::Rate;

/// Collects faces; points and corners are numbered in the order in which OpenUSD lists them.
class FaceList {
public:
    /// Triangles from a ring of points to a point, which comes before the ring (below) or after it.
    /// @param ring number of the ring's first point
    void fan(int ring, int tip, bool below) {
        for (int i = 0; i < shapeFacesAround; ++i) {
            const int here = ring + i, next = ring + (i + 1) % shapeFacesAround, c = _corners;
            if (below) // listed as next, here, tip
                add({c + 2, c + 2, c, c + 1}, {tip, tip, next, here}, 3);
            else
                add({c, c + 1, c + 2, c + 2}, {here, next, tip, tip}, 3);
        }
    }
    /// Quads from each of some rings to the one after it.
    void strips(int ring, int count) {
        for (int j = 0; j < count; ++j, ring += shapeFacesAround)
            for (int i = 0; i < shapeFacesAround; ++i) {
                const int next = (i + 1) % shapeFacesAround, up = shapeFacesAround;
                quad({ring + i, ring + next, ring + next + up, ring + i + up}, 0);
            }
    }
    /// @param points in the order in which they are listed
    /// @param first which of them is at (0, 0); the others follow
    void quad(const std::array<int, 4>& points, int first) {
        std::array<int, 4> corners, at;
        for (int k = 0; k < 4; ++k) {
            corners[k] = _corners + (first + k) % 4;
            at[k] = points[(first + k) % 4];
        }
        add(corners, at, 4);
    }
    ShapeFaces finish(int points) {
        const size_t n = size_t(points);
        _out.counts = {_out.faces.size(), n, n, size_t(_corners)};
        return std::move(_out);
    }

private:
    void add(const std::array<int, 4>& corners, const std::array<int, 4>& points, int count) {
        _out.faces.push_back({corners, points});
        _corners += count;
    }

    ShapeFaces _out;
    int _corners = 0;
};

} // namespace

ShapeFaces facesOf(const Implicit& prim) {
    constexpr int ring = shapeFacesAround;
    FaceList list;
    switch (prim.shape) {
    case ImplicitShape::Sphere:
    case ImplicitShape::Capsule: {
        const bool sphere = prim.shape == ImplicitShape::Sphere;
        const int strips = sphere ? sphereFaceRows - 2 : 2 * capFaceRows - 1;
        const int last = 1 + strips * ring;
        list.fan(1, 0, true);
        list.strips(1, strips);
        list.fan(last, last + ring, false);
        return list.finish(last + ring + 1);
    }
    case ImplicitShape::Cylinder: // rings are there twice: of caps and of the side
        list.fan(1, 0, true);
        list.strips(1 + ring, 1);
        list.fan(1 + 3 * ring, 1 + 4 * ring, false);
        return list.finish(2 + 4 * ring);
    case ImplicitShape::Cone: // with a ring of points at its tip
        list.fan(1, 0, true);
        list.strips(1 + ring, 1);
        return list.finish(1 + 3 * ring);
    case ImplicitShape::Cube:
        list.quad({0, 1, 2, 3}, 2); // +z
        list.quad({4, 5, 6, 7}, 3); // -z
        list.quad({0, 6, 5, 1}, 2); // +y
        list.quad({4, 7, 3, 2}, 3); // -y
        list.quad({0, 3, 7, 6}, 2); // +x
        list.quad({4, 2, 1, 5}, 3); // -x
        return list.finish(8);
    case ImplicitShape::Plane: list.quad({0, 1, 2, 3}, prim.axis == 1 ? 3 : 2); break;
    }
    return list.finish(4);
}

bool countsFaces(const Implicit& prim) {
    return !prim.subsets.empty() ||
           std::any_of(prim.primvars.begin(), prim.primvars.end(), [](const Primvar& p) {
               const size_t stored = p.values.size() / size_t(std::max(p.components, 1));
               return p.interpolation != Interpolation::Constant && p.name != "normals" &&
                      (p.indices.empty() ? stored : p.indices.size()) != 1;
           });
}

bool expandOnFaces(const Primvar& primvar, const ShapeFaces& shape, const TriangleMesh& mesh,
                   const std::vector<FacePlace>& places, const std::string& prim,
                   Diagnostics& diagnostics, MeshAttribute& out) {
    std::vector<float> values;
    if (!expandPrimvar(primvar, shape.counts, prim, diagnostics, values)) return false;
    out.name = primvar.name;
    out.components = primvar.components;
    if (primvar.interpolation == Interpolation::Uniform) {
        out.rate = Rate::PerFace;
        out.data = std::move(values);
        return true;
    }
    const bool ofCorners = primvar.interpolation == Interpolation::FaceVarying;
    const size_t n = size_t(primvar.components);
    out.rate = ofCorners ? Rate::PerCorner : Rate::PerVertex;
    out.data.assign((ofCorners ? places.size() : mesh.positions[0].size()) * n, 0.0f);
    for (size_t i = 0; i < places.size(); ++i) {
        const ShapeFace& face = shape.faces[size_t(places[i].face)];
        const auto& elements = ofCorners ? face.corners : face.points;
        const vec2 at = places[i].at;
        const size_t to = ofCorners ? i : mesh.triangles[i / 3][int(i % 3)];
        for (size_t c = 0; c < n; ++c) {
            const auto value = [&](int k) { return values[size_t(elements[k]) * n + c]; };
            out.data[to * n + c] = glm::mix(glm::mix(value(0), value(1), at.x),
                                            glm::mix(value(3), value(2), at.x), at.y);
        }
    }
    return true;
}

} // namespace patina

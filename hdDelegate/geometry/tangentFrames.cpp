// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tangentFrames.h"

#include "hdDelegate/geometry/primvarEval.h"
#include "materialNetwork/shadingPoint.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

bool usable(const vec3& v) {
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length);
}

} // namespace

TangentFrame tangentFrame(const vec3 positions[3], const vec2 st[3]) {
    TangentFrame frame;
    const vec3 e1 = positions[1] - positions[0], e2 = positions[2] - positions[0];
    const vec2 d1 = st[1] - st[0], d2 = st[2] - st[0];
    const float determinant = d1.x * d2.y - d1.y * d2.x;
    const vec3 n = glm::cross(e1, e2);
    if (!usable(n)) return frame;
    // Relative to the lengths: below this the coordinates are collinear up to rounding.
    if (std::abs(determinant) > 1e-7f * glm::length(d1) * glm::length(d2)) {
        frame.dpdu = (d2.y * e1 - d1.y * e2) / determinant;
        frame.dpdv = (d1.x * e2 - d2.x * e1) / determinant;
        frame.fromTexture = usable(frame.dpdu) && usable(frame.dpdv);
        frame.mirrored = determinant < 0.0f;
        frame.uvPerLength = std::sqrt(std::abs(determinant) / glm::length(n));
    }
    if (!frame.fromTexture) orthonormalBasis(n / glm::length(n), frame.dpdu, frame.dpdv);
    return frame;
}

TangentFrame tangentFrame(const TriangleMesh& mesh, const MeshAttribute* st, unsigned triangle,
                          size_t step) {
    vec3 positions[3];
    vec2 coordinates[3] = {vec2(0.0f), vec2(0.0f), vec2(0.0f)};
    for (int k = 0; k < 3; ++k) {
        positions[k] = mesh.positions[step][mesh.triangles[triangle][k]];
        float value[4];
        if (st && st->components >= 2 &&
            evalAttribute(mesh, *st, triangle, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f, value))
            coordinates[k] = vec2(value[0], value[1]);
    }
    return tangentFrame(positions, coordinates);
}

int tangentSet(const std::vector<MeshAttribute>& attributes, const std::string& wanted) {
    static const std::vector<std::string> usual = {"st", "uv", "UVMap", "map1"};
    int found = -1, rank = 0;
    for (size_t i = 0; i < attributes.size(); ++i) {
        const MeshAttribute& a = attributes[i];
        const bool varies =
            a.rate == MeshAttribute::Rate::PerVertex || a.rate == MeshAttribute::Rate::PerCorner;
        if (!varies || a.components < 2) continue;
        if (a.name == wanted) return int(i);
        if (a.components > 2) continue;
        const int its = int(std::find(usual.begin(), usual.end(), a.name) - usual.begin());
        if (found < 0 || its < rank || (its == rank && a.name < attributes[size_t(found)].name)) {
            found = int(i);
            rank = its;
        }
    }
    return found;
}

const MeshAttribute* tangentSet(const TriangleMesh& mesh, const std::string& wanted) {
    const int i = tangentSet(mesh.attributes, wanted);
    return i >= 0 ? &mesh.attributes[size_t(i)] : nullptr;
}

MeshPrimvar::MeshPrimvar(const TriangleMesh& mesh, const std::string& name)
    : attribute(mesh.attribute(name)) {
    if (attribute) return;
    attribute = mesh.attribute(setOfTangents(name));
    tangents = attribute != nullptr;
}

bool MeshPrimvar::read(const TriangleMesh& mesh, unsigned triangle, float u, float v,
                       float out[4]) const {
    if (!attribute) return false;
    if (!tangents) return evalAttribute(mesh, *attribute, triangle, u, v, out);
    const vec4 value = tangentFrame(mesh, attribute, triangle).value();
    std::copy_n(&value.x, 4, out);
    return true;
}

} // namespace patina

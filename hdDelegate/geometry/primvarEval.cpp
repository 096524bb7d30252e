// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/primvarEval.h"

#include "hdDelegate/geometry/curveSegments.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using Rate = MeshAttribute::Rate;

/// Adds weighted values; remembers whether all of them were there.
struct Mixer {
    const MeshAttribute& attribute;
    float* out;
    bool valid = true;

    Mixer(const MeshAttribute& a, float* o) : attribute(a), out(o) { std::fill_n(out, 4, 0.0f); }
    void add(size_t index, float weight) {
        const size_t first = index * attribute.components;
        if (first + attribute.components > attribute.data.size()) {
            valid = false;
            return;
        }
        for (int i = 0; i < std::min(attribute.components, 4); ++i)
            out[i] += weight * attribute.data[first + i];
    }
    bool finish() {
        if (!valid) std::fill_n(out, 4, 0.0f);
        return valid;
    }
};

vec3 normalAt(const TriangleMesh& mesh, size_t step, unsigned t, int corner) {
    const std::vector<vec3>& normals = mesh.normals[std::min(step, mesh.normals.size() - 1)];
    if (mesh.normalRate == Rate::PerFace) return normals[mesh.triangleFace[t]];
    if (mesh.normalRate == Rate::PerCorner) return normals[3 * size_t(t) + corner];
    return normals[mesh.triangles[t][corner]];
}

vec3 unitOrZero(const vec3& v) {
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length) ? v / length : vec3(0.0f);
}

} // namespace

bool evalAttribute(const TriangleMesh& mesh, const MeshAttribute& attribute, unsigned triangle,
                   float u, float v, float out[4]) {
    Mixer mixer(attribute, out);
    if (attribute.rate == Rate::Constant)
        mixer.add(0, 1.0f);
    else if (attribute.rate == Rate::PerFace)
        mixer.add(size_t(mesh.triangleFace[triangle]), 1.0f);
    else {
        const float weights[3] = {1.0f - u - v, u, v};
        const uvec3 vertices = mesh.triangles[triangle];
        for (int k = 0; k < 3; ++k)
            mixer.add(attribute.rate == Rate::PerVertex ? vertices[k] : 3 * size_t(triangle) + k,
                      weights[k]);
    }
    return mixer.finish();
}

bool evalAttribute(const CurveSet& curves, const MeshAttribute& attribute, unsigned segment,
                   float u, float out[4]) {
    Mixer mixer(attribute, out);
    if (attribute.rate == Rate::Constant) {
        mixer.add(0, 1.0f);
    } else if (attribute.rate == Rate::PerFace) {
        mixer.add(size_t(curves.segmentCurve[segment]), 1.0f);
    } else {
        const int values = valuesOfSegment(attribute.rate);
        const vec4 weights = valueWeights(attribute.rate, u);
        for (int k = 0; k < values; ++k)
            mixer.add(size_t(values) * segment + size_t(k), weights[k]);
    }
    return mixer.finish();
}

bool evalAttribute(const PointSet&, const MeshAttribute& attribute, unsigned point, float out[4]) {
    Mixer mixer(attribute, out);
    mixer.add(attribute.rate == Rate::Constant ? 0 : point, 1.0f);
    return mixer.finish();
}

vec3 evalNormal(const TriangleMesh& mesh, unsigned triangle, float u, float v, float time) {
    const auto blend = [&](size_t steps, const auto& at) {
        if (steps < 2) return at(size_t(0));
        const float x = std::clamp(time, 0.0f, 1.0f) * float(steps - 1);
        const size_t i = std::min(size_t(x), steps - 2);
        return at(i) * (1.0f - (x - float(i))) + at(i + 1) * (x - float(i));
    };
    if (!mesh.normals.empty()) {
        const vec3 n = unitOrZero(blend(mesh.normals.size(), [&](size_t step) {
            return normalAt(mesh, step, triangle, 0) * (1.0f - u - v) +
                   normalAt(mesh, step, triangle, 1) * u + normalAt(mesh, step, triangle, 2) * v;
        }));
        if (n != vec3(0.0f)) return n;
    }
    const uvec3 t = mesh.triangles[triangle];
    const auto corner = [&](int k) {
        return blend(mesh.positions.size(),
                     [&](size_t step) { return mesh.positions[step][t[k]]; });
    };
    const vec3 a = corner(0);
    return unitOrZero(glm::cross(corner(1) - a, corner(2) - a));
}

} // namespace patina

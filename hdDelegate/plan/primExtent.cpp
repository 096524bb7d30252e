// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/plan/primExtent.h"

#include <algorithm>
#include <cmath>

namespace patina {

bool subdivides(const Geometry& prim) {
    return prim.kind == GeometryKind::Mesh &&
           static_cast<const Mesh&>(prim).scheme != SubdivisionScheme::None;
}

float largestScale(const mat4& m) {
    return std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
}

float ScreenScale::unit(const mat4& toWorld, const vec3& center, float radius) const {
    const float scale = largestScale(toWorld);
    const float away = glm::length(vec3(toWorld * vec4(center, 1.0f)) - eye) - radius * scale;
    const float distance = perspective ? std::max(nearest, away) : 1.0f;
    return pixelSpread * distance / scale;
}

PrimExtent::PrimExtent(const Geometry& prim) {
    switch (prim.kind) {
    case GeometryKind::Mesh: measure(static_cast<const Mesh&>(prim)); break;
    case GeometryKind::Implicit: measure(static_cast<const Implicit&>(prim)); break;
    case GeometryKind::Curves:
        if (const Curves& p = static_cast<const Curves&>(prim); !p.points.empty())
            around(p.points.first());
        break;
    case GeometryKind::Points:
        if (const Points& p = static_cast<const Points&>(prim); !p.points.empty())
            around(p.points.first());
        break;
    case GeometryKind::Volume:
    case GeometryKind::Splats: break;
    }
    if (prim.kind != GeometryKind::Curves && prim.kind != GeometryKind::Points) return;
    // A single point has no other extent than its width.
    float widest = 0.0f;
    if (const Primvar* widths = prim.primvar("widths"))
        for (const float width : widths->values)
            if (std::isfinite(width)) widest = std::max(widest, width);
    low -= 0.5f * widest;
    high += 0.5f * widest;
}

void PrimExtent::around(const std::vector<vec3>& points) {
    vec3 lower(INFINITY), upper(-INFINITY);
    for (const vec3& p : points)
        if (std::isfinite(p.x + p.y + p.z)) {
            lower = glm::min(lower, p);
            upper = glm::max(upper, p);
        }
    if (!(lower.x <= upper.x)) return;
    empty = false;
    low = lower;
    high = upper;
}

void PrimExtent::measure(const Implicit& prim) {
    empty = false;
    const float wide = std::max({prim.radius, prim.radiusTop, 0.0f});
    const auto upright = [&](float half) {
        vec3 size(wide);
        size[std::clamp(prim.axis, 0, 2)] = half;
        return size;
    };
    switch (prim.shape) {
    case ImplicitShape::Sphere: high = vec3(std::max(prim.radius, 0.0f)); break;
    case ImplicitShape::Cube: high = vec3(0.5f * prim.size); break;
    case ImplicitShape::Cone:
    case ImplicitShape::Cylinder: high = upright(0.5f * prim.height); break;
    case ImplicitShape::Capsule: high = upright(0.5f * prim.height + wide); break;
    case ImplicitShape::Plane: {
        // Along the two axes that its own is not.
        const int axis = std::clamp(prim.axis, 0, 2);
        high = vec3(0.5f * std::max(prim.width, prim.length));
        high[axis] = 0.0f;
        break;
    }
    }
    low = -high;
}

void PrimExtent::measure(const Mesh& mesh) {
    if (mesh.points.empty()) return;
    const std::vector<vec3>& points = mesh.points.first();
    around(points);
    if (empty) return;
    const vec3 middle = center();
    const auto at = [&](size_t corner) {
        const int i = mesh.faceVertexIndices[corner];
        return i >= 0 && size_t(i) < points.size() ? points[size_t(i)] - middle : vec3(0.0f);
    };
    double sum = 0.0, volume = 0.0;
    size_t first = 0;
    for (const int count : mesh.faceVertexCounts) {
        if (count < 0 || first + size_t(count) > mesh.faceVertexIndices.size()) break;
        for (size_t k = 2; k < size_t(count); ++k) {
            const vec3 a = at(first), b = at(first + k - 1), c = at(first + k);
            sum += 0.5 * double(glm::length(glm::cross(b - a, c - a)));
            volume += double(glm::dot(a, glm::cross(b, c))) / 6.0;
        }
        first += size_t(count);
    }
    if (!std::isfinite(sum) || !std::isfinite(volume)) sum = volume = 0.0;
    area = float(sum);
    across = glm::length(high - low) / std::sqrt(3.0f);
    const float ball = sum > 0.0 ? float(6.0 * std::abs(volume) / sum) : 0.0f;
    round = std::clamp(ball, 0.125f * across, across);
}

} // namespace patina

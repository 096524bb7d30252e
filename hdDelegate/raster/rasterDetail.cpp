#include "hdDelegate/raster/rasterDetail.h"

#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// The extent of prims that can be drawn more or less finely. @returns false for others
bool extentOf(const Geometry& prim, vec3& low, vec3& high) {
    if (prim.kind == GeometryKind::Implicit) {
        const Implicit& p = static_cast<const Implicit&>(prim);
        high = vec3(std::max({p.radius, p.radiusTop, 0.5f * p.height + p.radius}));
        low = -high;
        return p.shape != ImplicitShape::Cube && p.shape != ImplicitShape::Plane;
    }
    if (prim.kind != GeometryKind::Mesh) return false;
    const Mesh& mesh = static_cast<const Mesh&>(prim);
    if (mesh.scheme == SubdivisionScheme::None || mesh.points.empty()) return false;
    low = vec3(INFINITY);
    high = vec3(-INFINITY);
    for (const vec3& p : mesh.points.first())
        if (std::isfinite(p.x + p.y + p.z)) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    return low.x <= high.x;
}

} // namespace

RasterDetail::RasterDetail(const Geometry& prim, const RasterCamera& camera,
                           const RenderSettings& settings, bool displaced) {
    vec3 low(0.0f), high(0.0f);
    if (!(settings.edgeLength > 0.0f) || !extentOf(prim, low, high)) return;
    _view = camera.view(vec2(0.0f), vec2(0.0f), 0.5f, low, high);
    _toGroup = transformAt(prim.transform, camera.timeCode(0.5f));
    _center = 0.5f * (low + high);
    _radius = 0.5f * glm::length(high - low);
    _nearest = camera.camera().clipNear;
    _edge = (displaced ? 1.0f : 2.0f) * settings.edgeLength * _view.pixelSpread;
}

float RasterDetail::edgeAt(const RasterPlace& place) const {
    if (!(_edge > 0.0f) || !(_radius > 0.0f)) return 0.0f;
    const mat4 m = place.groupToWorld * _toGroup;
    const float scale =
        std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
    const vec3 center = vec3(m * vec4(_center, 1.0f));
    const float away = glm::length(center - _view.eye) - _radius * scale;
    const float distance = _view.perspective ? std::max(_nearest, away) : 1.0f;
    // No edge is longer than the prim: those far away are all drawn alike.
    const float wanted = std::min(_edge * distance / scale, 2.0f * _radius);
    if (!std::isfinite(wanted) || !(wanted > 0.0f)) return 0.0f;
    return std::exp2(std::floor(std::log2(wanted)));
}

} // namespace patina

#include "hdDelegate/raster/scene/rasterDetail.h"

#include "hdDelegate/geometry/tessellate.h"
#include "hdDelegate/plan/subdivisionPlan.h"
#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace patina {

RasterExtent::RasterExtent(const Geometry& prim) {
    if (prim.kind == GeometryKind::Implicit) {
        const Implicit& p = static_cast<const Implicit&>(prim);
        high = vec3(std::max({p.radius, p.radiusTop, 0.5f * p.height + p.radius}));
        low = -high;
        refines = p.shape != ImplicitShape::Cube && p.shape != ImplicitShape::Plane;
        round = refines;
        if (round) finest = 6.2831853f / float(roundSegments) * std::max(p.radius, p.radiusTop);
    }
    const auto around = [&](const std::vector<vec3>& points) {
        low = vec3(INFINITY);
        high = vec3(-INFINITY);
        for (const vec3& p : points)
            if (std::isfinite(p.x + p.y + p.z)) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        refines = low.x <= high.x;
    };
    slight = prim.kind == GeometryKind::Curves || prim.kind == GeometryKind::Points;
    if (prim.kind == GeometryKind::Curves && !static_cast<const Curves&>(prim).points.empty())
        around(static_cast<const Curves&>(prim).points.first());
    if (prim.kind == GeometryKind::Points && !static_cast<const Points&>(prim).points.empty())
        around(static_cast<const Points&>(prim).points.first());
    if (slight) {
        // Widths count too: a single point has no other extent.
        float wide = 0.0f;
        if (const Primvar* widths = prim.primvar("widths"))
            for (const float width : widths->values)
                if (std::isfinite(width)) wide = std::max(wide, width);
        low -= 0.5f * wide;
        high += 0.5f * wide;
    }
    if (prim.kind != GeometryKind::Mesh) return;
    const Mesh& mesh = static_cast<const Mesh&>(prim);
    if (mesh.points.empty()) return;
    const std::vector<vec3>& points = mesh.points.first();
    around(points);
    if (mesh.scheme == SubdivisionScheme::None) {
        refines = false;
        return;
    }
    double sum = 0.0;
    const auto point = [&](size_t corner) {
        const int i = mesh.faceVertexIndices[corner];
        return i >= 0 && size_t(i) < points.size() ? points[size_t(i)] : vec3(0.0f);
    };
    size_t first = 0;
    for (const int count : mesh.faceVertexCounts) {
        if (count < 0 || first + size_t(count) > mesh.faceVertexIndices.size()) break;
        for (size_t k = 2; k < size_t(count); ++k)
            sum += 0.5 * glm::length(glm::cross(point(first + k - 1) - point(first),
                                                point(first + k) - point(first)));
        first += size_t(count);
    }
    area = std::isfinite(sum) ? float(sum) : 0.0f;
}

RasterDetail::RasterDetail(const RasterExtent& extent, const MotionTransform& transform,
                           const RasterCamera& camera, const RenderSettings& settings,
                           bool displaced, bool glows)
    : _gap((glows ? 0.25f : 1.0f) * largestGap *
           std::clamp(camera.pixels() / gapPixels, 0.25f, 1.0f)),
      _area(extent.area), _round(extent.round), _slight(extent.slight), _displaced(displaced) {
    _finest = extent.finest;
    if (!(settings.edgeLength > 0.0f) || !(extent.refines || displaced)) return;
    const vec3 &low = extent.low, &high = extent.high;
    _view = camera.view(vec2(0.0f), vec2(0.0f), 0.5f, low, high);
    _toGroup = exactTransformAt(transform, camera.timeCode(0.5f));
    _center = 0.5f * (low + high);
    _radius = 0.5f * glm::length(high - low);
    _nearest = camera.camera().clipNear;
    _edgeLength = settings.edgeLength;
    const float finer = std::min(_edgeLength / SubdivisionPlan::standardEdge, 1.0f);
    _gap *= finer * finer;
}

float RasterDetail::chord(float unit) const {
    // Parts of a mesh are rounder than the whole.
    const float curved = _round ? _radius / std::sqrt(3.0f) : 0.25f * _radius;
    return std::sqrt(8.0f * _gap * unit * curved);
}

size_t RasterDetail::trianglesFor(float edge) const {
    if (_displaced || !(_area > 0.0f) || !(edge > 0.0f)) return SIZE_MAX;
    const double side = double(std::min(edge, chord(edge / _edgeLength)));
    // An equilateral triangle has sqrt(3) / 4 of the square of its edge.
    return size_t(std::clamp(double(_area) / (0.433 * side * side), 64.0, 1e9));
}

float RasterDetail::edgeAt(const RasterPlace& place) const {
    if (!(_edgeLength > 0.0f) || !(_radius > 0.0f)) return 0.0f;
    const mat4 m(place.groupToWorld * _toGroup);
    const float scale =
        std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
    const vec3 center = vec3(m * vec4(_center, 1.0f));
    const float away = glm::length(center - _view.eye) - _radius * scale;
    const float distance = _view.perspective ? std::max(_nearest, away) : 1.0f;
    const float unit = _view.pixelSpread * distance / scale, asked = _edgeLength * unit;
    float wanted = asked;
    if (_slight)
        wanted = unit;
    else if (!_displaced)
        // Shorter edges than twice the finest change nothing.
        wanted =
            std::max(std::clamp(chord(unit), _round ? 0.0f : asked, 2.0f * asked), 1.99f * _finest);
    // Those far away are all drawn alike, and a cage of few faces must not be its few limit points:
    // the surface between them is up to twice as wide.
    wanted = std::min(wanted, (_round || _slight ? 2.0f : 0.5f) * _radius);
    if (!std::isfinite(wanted) || !(wanted > 0.0f)) return 0.0f;
    return std::exp2(std::floor(std::log2(wanted)));
}

} // namespace patina

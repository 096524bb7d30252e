// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterDetail.h"

#include "hdDelegate/geometry/tessellate.h"
#include "hdDelegate/scene/lightUnits.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace patina {

namespace {

bool isRound(const Geometry& prim) {
    if (prim.kind != GeometryKind::Implicit) return false;
    const ImplicitShape shape = static_cast<const Implicit&>(prim).shape;
    return shape != ImplicitShape::Cube && shape != ImplicitShape::Plane;
}

} // namespace

RasterDetail::RasterDetail(const Geometry& prim, const PrimExtent& extent,
                           const RasterCamera& camera, const RenderSettings& settings,
                           float edgeLength, bool displaced, bool glows)
    : _gap((glows ? 0.25f : 1.0f) * largestGap *
           std::clamp(camera.pixels() / gapPixels, 0.25f, 1.0f)),
      _round(isRound(prim)),
      _slight(prim.kind == GeometryKind::Curves || prim.kind == GeometryKind::Points),
      _displaced(displaced) {
    const bool subdivided = subdivides(prim);
    if (subdivided) _area = extent.area;
    _center = extent.center();
    _radius = extent.radius();
    if (_round) {
        const Implicit& p = static_cast<const Implicit&>(prim);
        _finest = 2.0f * pi / float(roundSegments) * std::max(p.radius, p.radiusTop);
        // One that a capsule of these sizes is in, whatever the shape.
        _radius = std::sqrt(3.0f) * std::max({p.radius, p.radiusTop, 0.5f * p.height + p.radius});
    }
    const bool refines = !extent.empty && (subdivided || _round || _slight);
    if (!(edgeLength > 0.0f) || !(refines || displaced)) return;
    _screen = screenScale(camera.camera(), settings, dvec3(0.0)); // it is where places are
    _toGroup = exactTransformAt(prim.transform, camera.timeCode(0.5f));
    _edgeLength = edgeLength;
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
    const float unit = _screen.unit(mat4(place.groupToWorld * _toGroup), _center, _radius);
    const float asked = _edgeLength * unit;
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

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/surfaceShapes.h"

#include "hdDelegate/geometry/primvarExpand.h"
#include "hdDelegate/scene/primCompare.h"

#include <algorithm>
#include <cmath>

namespace patina {

float EdgeTargets::of(const Geometry& prim, const PrimExtent& extent, float pixels) {
    if (extent.empty) return 0.0f;
    float edge = 0.0f;
    const mat4 toGroup = _space.still(prim.transform, prim.group);
    const auto look = [&](const mat4& place) {
        const mat4 m = place * toGroup;
        const float wanted = pixels * _screen.unit(m, extent.center(), extent.radius());
        if (std::isfinite(wanted) && wanted > 0.0f)
            edge = edge > 0.0f ? std::min(edge, wanted) : wanted;
    };
    constexpr double many = 1 << 20; // of which a list would take more memory than time
    if (_places.count(prim.group) > many) {
        _places.each(prim.group, look);
    } else {
        auto places = _transforms.find(prim.group);
        if (places == _transforms.end())
            places = _transforms.emplace(prim.group, _places.transforms(prim.group)).first;
        std::for_each(places->second.begin(), places->second.end(), look);
    }
    // Far away a cage of few faces would stay as it is: up to twice as wide as its surface.
    if (subdivides(prim) && edge > 0.0f) edge = std::min(edge, 0.5f * extent.radius());
    return edge > 0.0f ? std::exp2(std::floor(std::log2(edge))) : 0.0f;
}

float EdgeTargets::round(const Implicit& prim) const {
    // Half of what one of 64 samples counts in a pixel that the outline crosses.
    constexpr float gap = 1.0f / 128.0f; // pixels between an outline and its segments
    const float radius = std::max({prim.radius, prim.radiusTop, 0.0f});
    const float across = std::max({radius, 0.5f * prim.height, 0.5f * prim.size});
    const mat4 m = _space.still(prim.transform, prim.group);
    const float pixel = _screen.unit(m, vec3(0.0f), 2.0f * across);
    // A segment of length s lies s^2 / 8 r inside of a circle, and two thirds of that inside of one
    // that its polygon is as wide as in the mean, which is how coarse shapes are made.
    const float edge = std::sqrt(12.0f * gap * std::max(pixel, 0.0f) * radius);
    // A change without an effect is no reason to draw anew.
    const int coarser = std::isfinite(edge) ? roundCoarseness(prim, edge) : 1;
    return coarser > 1 ? roundEdgeOf(radius, coarser) : 0.0f;
}

std::shared_ptr<Surface> shapeSurface(const std::shared_ptr<const Geometry>& prim, float edge,
                                      const Programs& displacers, bool keepRest,
                                      const TracedSpace& space, CompiledShapes& shapes,
                                      Diagnostics& diagnostics) {
    auto surface = std::make_shared<Surface>();
    surface->prim = prim;
    surface->shape = prim->kind == GeometryKind::Curves   ? Surface::Shape::Curves
                     : prim->kind == GeometryKind::Points ? Surface::Shape::Points
                                                          : Surface::Shape::Triangles;
    ShapeRequest request{prim, {}, displacers};
    request.options.shutterOpen = space.open;
    request.options.shutterClose = space.close;
    request.options.withMoments = space.withMoments;
    request.options.targetEdge = edge;
    if (displacers.empty()) request.options.roundEdge = edge;
    request.toWorld = displacementSpace(*prim, 0.5f * (space.open + space.close));
    if (keepRest) {
        surface->rest = shapes.shape(request);
        surface->placed = atRest(*surface->rest);
    } else {
        PrimShape shape = makeShape(request, diagnostics);
        surface->placed = takeAtRest(shape);
        surface->rest = std::make_shared<const PrimShape>(std::move(shape));
    }
    if (space.withMoments && deforms(*prim)) surface->moments = takeMoments(surface->placed);
    return surface;
}

std::shared_ptr<Surface> shareSurface(const std::shared_ptr<const Geometry>& prim,
                                      const std::shared_ptr<const SharedShape>& shared,
                                      const TracedSpace& space, Diagnostics& diagnostics) {
    auto surface = std::make_shared<Surface>();
    surface->prim = prim;
    surface->shared = shared;
    const mat4 placement = SharedShapes::placement(static_cast<const Implicit&>(*prim));
    for (const mat4& m : space.steps(prim->transform, prim->group))
        surface->places.push_back(m * placement);
    surface->groupToObject = placement;
    for (const Primvar& primvar : prim->primvars) {
        MeshAttribute attribute;
        if (primvar.name != "normals" &&
            expandConstant(primvar, prim->path, diagnostics, attribute))
            surface->own.push_back(std::move(attribute));
    }
    return surface;
}

std::shared_ptr<Surface> moveSurface(const Surface& surface,
                                     const std::shared_ptr<const Geometry>& prim,
                                     const TracedSpace& space) {
    auto moved = std::make_shared<Surface>(surface);
    moved->prim = prim;
    moved->placed = atRest(*moved->rest);
    if (space.withMoments && deforms(*prim)) moved->moments = takeMoments(moved->placed);
    return moved;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
// Surfaces of EmbreeScene: how finely a prim is tessellated, its shape, its materials.

#include "hdDelegate/compiled/drawFilter.h"
#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/surfaceSpace.h"
#include "hdDelegate/geometry/primvarExpand.h"
#include "hdDelegate/scene/primCompare.h"
#include "materialNetwork/material.h"
#include "materialNetwork/shadingPoint.h"

#include <algorithm>
#include <cmath>

namespace patina {

float EmbreeScene::targetEdge(CachedSurface& cached, const std::shared_ptr<const Geometry>& prim,
                              bool displaced, View& view) {
    const bool refined = subdivides(*prim);
    const float pixels = _subdivision.edgeOf(displaced);
    if ((!displaced && !refined) || !(pixels > 0.0f)) return 0.0f;
    cached.extent = _compiled.extents().of(prim);
    const PrimExtent& extent = *cached.extent;
    if (extent.empty) return 0.0f;
    float edge = 0.0f;
    const mat4 toGroup = interpolate(prim->transform, 0.0f, originOf(prim->group));
    const auto look = [&](const mat4& place) {
        const mat4 m = place * toGroup;
        const float wanted = pixels * view.screen.unit(m, extent.center(), extent.radius());
        if (std::isfinite(wanted) && wanted > 0.0f)
            edge = edge > 0.0f ? std::min(edge, wanted) : wanted;
    };
    constexpr double many = 1 << 20; // of which a list would take more memory than time
    if (placeCount(prim->group) > many) {
        forTransforms(prim->group, look);
    } else {
        auto places = view.transformsOf.find(prim->group);
        if (places == view.transformsOf.end())
            places = view.transformsOf.emplace(prim->group, groupTransforms(prim->group)).first;
        std::for_each(places->second.begin(), places->second.end(), look);
    }
    // Far away a cage of few faces would stay as it is: up to twice as wide as its surface.
    if (refined && edge > 0.0f) edge = std::min(edge, 0.5f * extent.radius());
    return edge > 0.0f ? std::exp2(std::floor(std::log2(edge))) : 0.0f;
}

std::shared_ptr<Surface> EmbreeScene::shape(const std::shared_ptr<const Geometry>& prim,
                                            float edgeLength, const Programs& displacers,
                                            bool keepRest) const {
    auto surface = std::make_shared<Surface>();
    surface->prim = prim;
    surface->shape = prim->kind == GeometryKind::Curves   ? Surface::Shape::Curves
                     : prim->kind == GeometryKind::Points ? Surface::Shape::Points
                                                          : Surface::Shape::Triangles;
    ShapeRequest request{prim, {}, displacers};
    request.options.shutterOpen = _shutterOpen;
    request.options.shutterClose = _shutterClose;
    request.options.withMoments = _withMoments;
    request.options.targetEdge = edgeLength;
    if (displacers.empty()) request.options.roundEdge = edgeLength;
    request.toWorld = displacementSpace(*prim, 0.5f * (_shutterOpen + _shutterClose));
    if (keepRest) {
        surface->rest = _compiled.shapes().shape(request);
        surface->placed = atRest(*surface->rest);
    } else {
        PrimShape shape = makeShape(request, _diagnostics);
        surface->placed = takeAtRest(shape);
        surface->rest = std::make_shared<const PrimShape>(std::move(shape));
    }
    if (_withMoments && deforms(*prim)) surface->moments = takeMoments(surface->placed);
    return surface;
}

float EmbreeScene::roundEdge(const Implicit& prim, const View& view) const {
    const ScreenScale& screen = view.screen;
    // Half of what one of 64 samples counts in a pixel that the outline crosses.
    constexpr float gap = 1.0f / 128.0f; // pixels between an outline and its segments
    const float radius = std::max({prim.radius, prim.radiusTop, 0.0f});
    const float across = std::max({radius, 0.5f * prim.height, 0.5f * prim.size});
    const mat4 m = interpolate(prim.transform, 0.0f, _origin);
    const float pixel = screen.unit(m, vec3(0.0f), 2.0f * across);
    // A segment of length s lies s^2 / 8 r inside of a circle, and two thirds of that inside of one
    // that its polygon is as wide as in the mean, which is how coarse shapes are made.
    const float edge = std::sqrt(12.0f * gap * std::max(pixel, 0.0f) * radius);
    // A change without an effect is no reason to draw anew.
    const int coarser = std::isfinite(edge) ? roundCoarseness(prim, edge) : 1;
    return coarser > 1 ? roundEdgeOf(radius, coarser) : 0.0f;
}

bool EmbreeScene::glows(const Geometry& prim, const View& view) {
    const auto material = [&](const std::string& path) {
        return view.state.materials.count(path) > 0 &&
               program(path, prim.path, view)->hasEmission();
    };
    return material(prim.material) ||
           std::any_of(prim.subsets.begin(), prim.subsets.end(), [&](const GeomSubset& subset) {
               return !subset.material.empty() && material(subset.material);
           });
}

std::shared_ptr<Surface>
EmbreeScene::shape(const std::shared_ptr<const Geometry>& prim,
                   const std::shared_ptr<const SharedShape>& shared) const {
    auto surface = std::make_shared<Surface>();
    surface->prim = prim;
    surface->shared = shared;
    const mat4 placement = SharedShapes::placement(static_cast<const Implicit&>(*prim));
    for (const mat4& m :
         resample(prim->transform, _shutterOpen, _shutterClose, originOf(prim->group)))
        surface->places.push_back(m * placement);
    surface->groupToObject = placement;
    for (const Primvar& primvar : prim->primvars) {
        MeshAttribute attribute;
        if (primvar.name != "normals" &&
            expandConstant(primvar, prim->path, _diagnostics, attribute))
            surface->own.push_back(std::move(attribute));
    }
    return surface;
}

void EmbreeScene::updateSurface(const Work& work, bool keepRest) {
    CachedSurface& cached = *work.cached;
    const std::shared_ptr<const Geometry>& prim = work.prim;
    const std::shared_ptr<const SharedShape>& shared = work.shared;
    const bool moved = cached.prim && !sameTransform(cached.prim->transform, prim->transform);
    // Displacement reads the world.
    const bool reshape = !cached.surface || cached.edgeLength != work.edge ||
                         cached.displacers != work.displacers ||
                         (moved && !work.displacers.empty()) || !sameShape(*cached.prim, *prim);
    if (!reshape && !moved && cached.shared == shared) {
        cached.prim = cached.surface->prim = prim;
        return;
    }
    std::shared_ptr<Surface> surface;
    Programs displacers = work.displacers; // no memory may be missing while `cached` changes
    bool keepsRest = !shared && cached.keepsRest;
    if (shared) {
        surface = shape(prim, shared);
    } else if (reshape || cached.shared || !cached.keepsRest) {
        surface = shape(prim, work.edge, work.displacers, keepRest);
        keepsRest = keepRest;
        ++_counts.tessellated;
    } else {
        surface = std::make_shared<Surface>(*cached.surface);
        surface->prim = prim;
        surface->placed = atRest(*surface->rest);
        if (_withMoments && deforms(*prim)) surface->moments = takeMoments(surface->placed);
    }
    if (!shared)
        bake(*surface,
             resample(prim->transform, _shutterOpen, _shutterClose, originOf(prim->group)));
    ++_counts.surfaces;
    cached.surface = std::move(surface);
    cached.edgeLength = work.edge;
    cached.shared = shared;
    cached.displacers = std::move(displacers);
    cached.keepsRest = keepsRest;
    cached.prim = prim;
}

std::shared_ptr<const MaterialProgram>
EmbreeScene::program(const std::string& path, const std::string& user, const View& view) {
    const RenderSettings& settings = view.settings;
    const auto prim = _compiled.materials().find(path, user, view.state, settings);
    auto program = _compiled.materials().program(prim, settings.methods, settings.tolerance);
    auto& known = _programs[prim ? path : std::string()];
    if (known != program) ++_counts.programs;
    return known = std::move(program);
}

EmbreeScene::Programs EmbreeScene::displacers(const Geometry& prim, const View& view) {
    if (prim.kind != GeometryKind::Mesh && prim.kind != GeometryKind::Implicit) return {};
    const auto mayDisplace = [&](const std::string& path) {
        const auto& materials = view.state.materials;
        const auto found = materials.find(path);
        return view.settings.enableSceneMaterials && found != materials.end() &&
               found->second->network.terminals.count("displacement") > 0;
    };
    bool any = false;
    Programs result;
    const auto add = [&](const std::string& path) {
        const auto own = mayDisplace(path) ? program(path, prim.path, view) : nullptr;
        result.push_back(own && own->hasDisplacement() ? own : nullptr);
        any |= result.back() != nullptr;
    };
    add(prim.material);
    for (const GeomSubset& subset : prim.subsets)
        add(subset.material.empty() ? prim.material : subset.material);
    return any ? result : Programs();
}

MaterialSlot EmbreeScene::makeSlot(const Surface& surface, const std::string& materialPath,
                                   const View& view) {
    MaterialSlot slot;
    slot.program = program(materialPath, surface.prim->path, view);
    const bool flat = surface.shape == Surface::Shape::Triangles;
    if (flat) slot.tangentSet = surface.findTangentSet(slot.program->tangentSet());
    _compiled.materials().tellOfSpaces(*slot.program, *surface.prim);
    const std::vector<MaterialPrimvar>& primvars = slot.program->primvars();
    for (size_t i = 0; i < primvars.size(); ++i) {
        slot.attributes.push_back(surface.findAttribute(primvars[i].name));
        const std::string set = setOfTangents(primvars[i].name);
        if (!flat || set.empty()) continue;
        slot.tangents.resize(primvars.size(), -1);
        slot.tangents[i] = surface.findAttribute(set);
    }
    std::vector<int> there = slot.attributes;
    if (!surface.prim->group.empty())
        for (size_t i = 0; i < there.size(); ++i)
            if (_parts.placements->haveValue(slot.program->primvars()[i].name)) there[i] = 0;
    slot.opaque = slot.program->isOpaqueWith(there);
    return slot;
}

} // namespace patina

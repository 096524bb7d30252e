// Surfaces of EmbreeScene: how finely a prim is tessellated, its shape, its materials.

#include "hdDelegate/compiled/drawFilter.h"
#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/surfaceSpace.h"
#include "hdDelegate/geometry/primvarExpand.h"
#include "hdDelegate/scene/primCompare.h"
#include "materialNetwork/material.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

float maxScale(const mat4& m) {
    return std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
}

} // namespace

float EmbreeScene::planSubdivision(const View& view) {
    const CameraRays& rays = view.rays;
    const RenderSettings& settings = view.settings;
    const ScreenScale screen{vec3(glm::inverse(rays.worldToCamera())[3]), !rays.orthographic(),
                             rays.pixelSpread(), rays.camera().clipNear,
                             double(settings.width) * settings.height};
    SubdivisionPlan plan(settings, screen);
    for (const auto& item : view.state.geometry) {
        const Geometry& prim = *item.second;
        if (!plan.isActive() || !subdivides(prim) || !isDrawn(prim, settings)) continue;
        std::vector<mat4> places = groupTransforms(prim.group);
        for (mat4& place : places)
            place = place * interpolate(prim.transform, 0.0f, originOf(prim.group));
        plan.add(CageSize(static_cast<const Mesh&>(prim)), places,
                 program(prim.material, prim.path, view)->planned());
    }
    _subdivision = plan.chosen();
    return plan.edgeLength();
}

float EmbreeScene::targetEdge(const Geometry& prim, bool displaced, View& view) const {
    const CameraRays& rays = view.rays;
    const RenderSettings& settings = view.settings;
    const bool refined = subdivides(prim);
    if ((!displaced && !refined) || !(settings.edgeLength > 0.0f)) return 0.0f;
    vec3 lower(INFINITY), upper(-INFINITY);
    if (prim.kind == GeometryKind::Implicit) {
        const Implicit& shape = static_cast<const Implicit&>(prim);
        upper = vec3(0.5f * std::max({2.0f * shape.radius, 2.0f * shape.radiusTop, shape.height,
                                      shape.size}));
        lower = -upper;
    } else if (const Mesh& mesh = static_cast<const Mesh&>(prim); !mesh.points.empty()) {
        for (const vec3& p : mesh.points.first())
            if (std::isfinite(p.x + p.y + p.z)) {
                lower = glm::min(lower, p);
                upper = glm::max(upper, p);
            }
    }
    auto places = view.transformsOf.find(prim.group);
    if (places == view.transformsOf.end())
        places = view.transformsOf.emplace(prim.group, groupTransforms(prim.group)).first;
    const vec3 eye = vec3(glm::inverse(rays.worldToCamera())[3]);
    float edge = 0.0f;
    for (const mat4& place : places->second) {
        const mat4 m = place * interpolate(prim.transform, 0.0f, originOf(prim.group));
        const float scale = maxScale(m);
        const vec3 center = vec3(m * vec4(0.5f * (lower + upper), 1.0f));
        const float radius = 0.5f * glm::length(upper - lower) * scale;
        const float distance = rays.orthographic() ? 1.0f
                                                   : std::max(view.camera.clipNear,
                                                              glm::length(center - eye) - radius);
        // Displacement shows more of itself on shorter edges, which no row of the table is of.
        const float asked = displaced && !_subdivision.forced && !_subdivision.point.empty()
                                ? std::min(settings.edgeLength, SubdivisionPlan::standardEdge)
                                : settings.edgeLength;
        const float wanted = asked * rays.pixelSpread() * distance / scale;
        if (std::isfinite(wanted) && wanted > 0.0f)
            edge = edge > 0.0f ? std::min(edge, wanted) : wanted;
    }
    // Far away a cage of few faces would stay as it is: up to twice as wide as its surface.
    if (refined && prim.kind == GeometryKind::Mesh && edge > 0.0f && upper.x >= lower.x)
        edge = std::min(edge, 0.25f * glm::length(upper - lower));
    return edge > 0.0f ? std::exp2(std::floor(std::log2(edge))) : 0.0f;
}

std::shared_ptr<Surface> EmbreeScene::shape(const std::shared_ptr<const Geometry>& prim,
                                            float edgeLength, const Programs& displacers,
                                            bool keepRest) const {
    auto surface = std::make_shared<Surface>();
    surface->prim = prim;
    TessellationOptions options;
    options.shutterOpen = _shutterOpen;
    options.shutterClose = _shutterClose;
    options.targetEdge = edgeLength;
    if (displacers.empty()) options.roundEdge = edgeLength;
    switch (prim->kind) {
    case GeometryKind::Mesh:
    case GeometryKind::Implicit: {
        ShapeRequest request{prim, options, displacers};
        if (!displacers.empty()) {
            const auto transforms = resample(prim->transform, _shutterOpen, _shutterClose);
            request.toWorld = transforms[transforms.size() / 2];
        }
        if (keepRest) {
            surface->rest = _compiled.shapes().triangles(request);
            surface->mesh.positions = surface->rest->positions;
            surface->mesh.normals = surface->rest->normals;
        } else {
            TriangleMesh mesh = makeTriangles(request, _diagnostics);
            surface->mesh.positions = std::move(mesh.positions);
            surface->mesh.normals = std::move(mesh.normals);
            surface->rest = std::make_shared<const TriangleMesh>(std::move(mesh));
        }
        break;
    }
    case GeometryKind::Curves:
        surface->shape = Surface::Shape::Curves;
        surface->curves = buildCurves(static_cast<const Curves&>(*prim), options, _diagnostics);
        break;
    case GeometryKind::Points:
        surface->shape = Surface::Shape::Points;
        surface->points = buildPoints(static_cast<const Points&>(*prim), options, _diagnostics);
        break;
    case GeometryKind::Volume: break; // no surface, see VolumeScene
    }
    surface->stAttribute = surface->findAttribute("st");
    return surface;
}

float EmbreeScene::roundEdge(const Implicit& prim, const View& view) const {
    const CameraRays& rays = view.rays;
    // Half of what one of 64 samples counts in a pixel that the outline crosses.
    constexpr float gap = 1.0f / 128.0f; // pixels between an outline and its segments
    const float radius = std::max({prim.radius, prim.radiusTop, 0.0f});
    const float across = std::max({radius, 0.5f * prim.height, 0.5f * prim.size});
    const vec3 eye = vec3(glm::inverse(rays.worldToCamera())[3]);
    const mat4 m = interpolate(prim.transform, 0.0f, _origin);
    const float scale = maxScale(m);
    const float away = glm::length(vec3(m[3]) - eye) - 2.0f * across * scale;
    const float distance = rays.orthographic() ? 1.0f : std::max(view.camera.clipNear, away);
    const float pixel = rays.pixelSpread() * distance / scale;
    // A segment of length s lies s^2 / 8 r inside of a circle, and two thirds of that inside of one
    // that its polygon is as wide as in the mean, which is how coarse shapes are made.
    const float edge = std::sqrt(12.0f * gap * std::max(pixel, 0.0f) * radius);
    // What makes no difference is no reason to draw anew.
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
            surface->mesh.attributes.push_back(std::move(attribute));
    }
    surface->stAttribute = surface->findAttribute("st");
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
    if (shared) {
        surface = shape(prim, shared);
        cached.rest = nullptr;
    } else if (reshape || cached.shared || !cached.rest) {
        surface = shape(prim, work.edge, work.displacers, keepRest);
        cached.rest = keepRest ? std::make_shared<const RestShape>(restOf(*surface)) : nullptr;
        ++_counts.tessellated;
    } else {
        surface = std::make_shared<Surface>(*cached.surface);
        surface->prim = prim;
        restore(*cached.rest, *surface);
    }
    if (!shared)
        bake(*surface,
             resample(prim->transform, _shutterOpen, _shutterClose, originOf(prim->group)));
    ++_counts.surfaces;
    cached.surface = std::move(surface);
    cached.edgeLength = work.edge;
    cached.shared = shared;
    cached.displacers = work.displacers;
    cached.prim = prim;
}

std::shared_ptr<const MaterialProgram>
EmbreeScene::program(const std::string& path, const std::string& user, const View& view) {
    const RenderSettings& settings = view.settings;
    CompiledMaterials& materials = _compiled.materials();
    const auto prim = materials.find(path, user, view.state, settings);
    const std::string key = prim ? path : std::string();
    CachedProgram& cached = _programs[key];
    if (!cached.program || cached.prim != prim || cached.methods != settings.methods ||
        cached.tolerance != settings.tolerance) {
        cached.prim = prim;
        cached.tolerance = settings.tolerance;
        cached.methods = settings.methods;
        ++_counts.programs;
        cached.program = materials.program(prim, settings.methods, settings.tolerance);
    }
    return cached.program;
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
        result.push_back(mayDisplace(path) ? program(path, prim.path, view) : nullptr);
        any |= result.back() && result.back()->hasDisplacement();
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
    for (const auto& primvar : slot.program->primvars())
        slot.attributes.push_back(surface.findAttribute(primvar.name));
    std::vector<int> there = slot.attributes;
    if (!surface.prim->group.empty())
        for (size_t i = 0; i < there.size(); ++i)
            if (_parts.placements->haveValue(slot.program->primvars()[i].name)) there[i] = 0;
    slot.opaque = slot.program->isOpaqueWith(there);
    return slot;
}

} // namespace patina

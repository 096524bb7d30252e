// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/drawnSurfaces.h"

#include "hdDelegate/compiled/drawFilter.h"
#include "hdDelegate/parallel.h"
#include "hdDelegate/scene/primCompare.h"
#include "materialNetwork/material.h"
#include "materialNetwork/shadingPoint.h"

#include <algorithm>

namespace patina {

namespace {

/// Only triangles are lights.
bool emits(const Surface& surface) {
    return surface.shape == Surface::Shape::Triangles &&
           std::any_of(surface.materials.begin(), surface.materials.end(),
                       [](const auto& m) { return m.program->hasEmission(); });
}

/// None where it shares them.
size_t trianglesOf(const Surface& surface) {
    return surface.rest ? surface.rest->mesh.triangles.size() : 0;
}

/// @param keepsRest what is placed stands once more in the prim's own space
size_t bytesOf(const Surface& surface, bool keepsRest) {
    size_t total = trianglesOf(surface) * sizeof(uvec3);
    const auto add = [&](const auto& steps) {
        for (const auto& step : steps)
            total += step.capacity() * sizeof(step[0]) * (keepsRest ? 2 : 1);
    };
    add(surface.placed.positions);
    add(surface.placed.points);
    add(surface.placed.normals);
    add(surface.moments.positions);
    add(surface.moments.points);
    for (const MeshAttribute& attribute : surface.attributes())
        total += attribute.data.size() * sizeof(float);
    return total;
}

/// Calls body(material) for a prim's own and that of each subset.
template <class Body> void forMaterials(const Geometry& prim, const Body& body) {
    body(prim.material);
    for (const GeomSubset& subset : prim.subsets)
        body(subset.material.empty() ? prim.material : subset.material);
}

} // namespace

DrawnSurfaces::DrawnSurfaces(CompiledScene& compiled, BuildCounts& counts)
    : _compiled(compiled), _diagnostics(compiled.scene()->diagnostics()), _counts(counts) {}

void DrawnSurfaces::clear() {
    _members.clear();
    _emitting.clear();
    _surfaces.clear();
    _shapes.clear();
}

DrawnSurfaces::Work DrawnSurfaces::workOf(const Ranked<Geometry>& ranked, Drawn& drawn,
                                          const SceneView& view, EdgeTargets& edges) {
    const auto& prim = ranked.prim;
    Work work{prim, &drawn, ranked.rank, 0.0f, displacers(*prim, view), {}, {}};
    const bool displaced = !work.displacers.empty();
    const float pixels = subdivision.edgeOf(displaced);
    if ((displaced || subdivides(*prim)) && pixels > 0.0f) {
        drawn.extent = _compiled.extents().of(prim);
        work.edge = edges.of(*prim, *drawn.extent, pixels);
    }
    // Prims of prototypes are shared already, and Embree may know a single level of instances.
    // Lights are made of the triangles that there are, and displacement of many.
    if (prim->kind == GeometryKind::Implicit && prim->group.empty() && !displaced &&
        !view.parts.meshLights->names(prim->path) && !glows(*prim, view)) {
        const Implicit& shape = static_cast<const Implicit&>(*prim);
        work.edge = edges.round(shape);
        work.key = SharedShapes::keyOf(shape, work.edge);
    }
    return work;
}

void DrawnSurfaces::doWork(const Work& work, const SceneView& view) {
    Drawn& drawn = *work.drawn;
    const std::shared_ptr<const Geometry>& prim = work.prim;
    const bool moved = drawn.prim && !sameTransform(drawn.prim->transform, prim->transform);
    // Displacement reads the world.
    const bool reshape = !drawn.surface || drawn.edge != work.edge ||
                         drawn.displacers != work.displacers ||
                         (moved && !work.displacers.empty()) || !sameShape(*drawn.prim, *prim);
    if (!reshape && !moved && drawn.shared == work.shared) {
        drawn.prim = drawn.surface->prim = prim;
        return;
    }
    std::shared_ptr<Surface> surface;
    Programs displacers = work.displacers; // no memory may be missing while `drawn` changes
    bool keepsRest = !work.shared && drawn.keepsRest;
    if (work.shared) {
        surface = shareSurface(prim, work.shared, view.space, _diagnostics);
    } else if (reshape || drawn.shared || !drawn.keepsRest) {
        keepsRest = view.settings.interactive;
        surface = shapeSurface(prim, work.edge, work.displacers, keepsRest, view.space,
                               _compiled.shapes(), _diagnostics);
        ++_counts.tessellated;
    } else {
        surface = moveSurface(*drawn.surface, prim, view.space);
    }
    if (!work.shared) bake(*surface, view.space.steps(prim->transform, prim->group));
    ++_counts.surfaces;
    drawn.surface = std::move(surface);
    drawn.edge = work.edge;
    drawn.shared = work.shared;
    drawn.displacers = std::move(displacers);
    drawn.keepsRest = keepsRest;
    drawn.prim = prim;
}

bool DrawnSurfaces::doWork(std::vector<Work>& work, const SceneView& view) {
    for (Work& item : work)
        if (item.key && (item.shared = _shapes.find(*item.key))) item.edge = 0.0f;
    parallelFor(size_t(0), work.size(), [&](size_t i) {
        if (view.stop) return;
        const Drawn& drawn = *work[i].drawn;
        if (drawn.prim == work[i].prim && drawn.edge == work[i].edge &&
            drawn.displacers == work[i].displacers && drawn.shared == work[i].shared &&
            drawn.surface)
            return;
        doWork(work[i], view);
    });
    if (view.stop) return false;
    for (const Work& item : work) {
        item.drawn->rank = item.rank;
        item.drawn->key = item.key;
    }
    return true;
}

void DrawnSurfaces::describe(Drawn& drawn, const SceneView& view) {
    Surface& surface = *drawn.surface;
    const Geometry& prim = *surface.prim;
    surface.primId = prim.id >= 0 ? prim.id : drawn.rank;
    surface.worldOrigin = vec3(view.space.origin);
    surface.categories = view.parts.links->of(prim.categories);
    surface.materials.clear();
    drawn.opaque = true;
    drawn.hasMedia = false;
    forMaterials(prim, [&](const std::string& material) {
        surface.materials.push_back(makeSlot(surface, material, view));
        drawn.opaque &= surface.materials.back().opaque;
        drawn.hasMedia |= surface.materials.back().program->hasInterior();
    });
    drawn.hasPriority = prim.dielectricPriority > 0;
    drawn.emits = emits(surface);
    if (drawn.emits)
        _emitting[prim.path] = &drawn;
    else
        _emitting.erase(prim.path);
    drawn.bytes = bytesOf(surface, drawn.keepsRest);
    count(drawn, true);
}

void DrawnSurfaces::count(const Drawn& drawn, bool isThere) {
    const size_t one = isThere ? 1 : size_t(-1);
    _totals.translucent += drawn.opaque ? 0 : one;
    _totals.withMedia += drawn.hasMedia ? one : 0;
    _totals.withPriority += drawn.hasPriority ? one : 0;
    _totals.bytes += one * drawn.bytes;
    _totals.triangles += one * trianglesOf(*drawn.surface);
}

bool DrawnSurfaces::update(RTCDevice device, const SceneView& view, const GroupPlaces& places,
                           const std::vector<Ranked<Geometry>>& prims) {
    _members.clear();
    _emitting.clear();
    _totals = Totals();
    std::vector<Work> work;
    std::map<ShapeKey, int> uses;
    std::map<ShapeKey, const Implicit*> examples;
    std::set<std::string> drawn;
    EdgeTargets edges(view.screen, view.space, places);
    for (const Ranked<Geometry>& ranked : prims) {
        const std::string& path = ranked.prim->path;
        drawn.insert(path);
        work.push_back(workOf(ranked, _surfaces[path], view, edges));
        if (const auto& key = work.back().key) {
            ++uses[*key];
            examples[*key] = static_cast<const Implicit*>(ranked.prim.get());
        }
    }
    for (auto it = _surfaces.begin(); it != _surfaces.end();)
        it = drawn.count(it->first) ? std::next(it) : _surfaces.erase(it);
    for (auto it = _programs.begin(); it != _programs.end();)
        it = it->first.empty() || view.state.materials.count(it->first) ? std::next(it)
                                                                        : _programs.erase(it);
    _shapes.update(device, uses, examples, _diagnostics);
    if (!doWork(work, view)) return false;
    for (const Work& item : work) {
        describe(*item.drawn, view);
        auto& members = _members[item.prim->group];
        item.drawn->member = members.size();
        members.push_back(item.drawn->surface);
    }
    return true;
}

std::optional<DrawnSurfaces::Changes>
DrawnSurfaces::updateTouched(const SceneView& view, const GroupPlaces& places,
                             const std::set<std::string>& touched, bool fillsSpace) {
    const SubdivisionPlan plan(view.settings, ScreenScale());
    EdgeTargets edges(view.screen, view.space, places);
    std::vector<Work> work;
    for (const std::string& path : touched) {
        ++_counts.looked;
        const auto& prim = view.state.geometry.at(path);
        const bool draws = isDrawn(*prim, view.settings);
        const auto known = _surfaces.find(path);
        // What is not drawn now may have been a volume or splats.
        if (!isSurface(prim->kind) || (known == _surfaces.end() && fillsSpace) ||
            draws != (known != _surfaces.end()))
            return std::nullopt;
        if (!draws) continue;
        Drawn& drawn = known->second;
        if (drawn.prim->group != prim->group) return std::nullopt;
        // How finely all subdivision surfaces are drawn depends on each of them.
        if (plan.isActive() && (subdivides(*prim) || subdivides(*drawn.prim))) return std::nullopt;
        work.push_back(workOf({prim, drawn.rank}, drawn, view, edges));
        if (work.back().key != drawn.key) return std::nullopt; // others share its shape, or did
    }
    struct Before {
        std::shared_ptr<Surface> surface;
        unsigned mask;
        bool emits;
    };
    std::vector<Before> before;
    for (const Work& item : work) {
        const Drawn& drawn = *item.drawn;
        before.push_back({drawn.surface, drawn.surface->prim->visibility.mask(), drawn.emits});
        count(drawn, false);
    }
    Changes changes;
    if (!doWork(work, view)) return changes; // the next update looks at everything
    for (size_t i = 0; i < work.size(); ++i) {
        Drawn& drawn = *work[i].drawn;
        describe(drawn, view);
        changes.emissive |= before[i].emits || drawn.emits;
        changes.meshLights |= view.parts.meshLights->names(drawn.prim->path);
        if (drawn.surface == before[i].surface && before[i].mask == drawn.prim->visibility.mask())
            continue;
        _members[drawn.prim->group][drawn.member] = drawn.surface;
        changes.surfaces[drawn.prim->group].push_back(drawn.surface);
    }
    return changes;
}

bool DrawnSurfaces::glows(const Geometry& prim, const SceneView& view) {
    bool any = false;
    forMaterials(prim, [&](const std::string& material) {
        any = any || (view.state.materials.count(material) > 0 &&
                      program(material, prim.path, view)->hasEmission());
    });
    return any;
}

std::shared_ptr<const MaterialProgram>
DrawnSurfaces::program(const std::string& path, const std::string& user, const SceneView& view) {
    const RenderSettings& settings = view.settings;
    const auto prim = _compiled.materials().find(path, user, view.state, settings);
    auto program = _compiled.materials().program(prim, settings.methods, settings.tolerance);
    auto& known = _programs[prim ? path : std::string()];
    if (known != program) ++_counts.programs;
    return known = std::move(program);
}

Programs DrawnSurfaces::displacers(const Geometry& prim, const SceneView& view) {
    if (prim.kind != GeometryKind::Mesh && prim.kind != GeometryKind::Implicit) return {};
    const auto mayDisplace = [&](const std::string& path) {
        const auto& materials = view.state.materials;
        const auto found = materials.find(path);
        return view.settings.enableSceneMaterials && found != materials.end() &&
               found->second->network.terminals.count("displacement") > 0;
    };
    bool any = false;
    Programs result;
    forMaterials(prim, [&](const std::string& path) {
        const auto own = mayDisplace(path) ? program(path, prim.path, view) : nullptr;
        result.push_back(own && own->hasDisplacement() ? own : nullptr);
        any |= result.back() != nullptr;
    });
    return any ? result : Programs();
}

MaterialSlot DrawnSurfaces::makeSlot(const Surface& surface, const std::string& material,
                                     const SceneView& view) {
    MaterialSlot slot;
    slot.program = program(material, surface.prim->path, view);
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
            if (view.parts.placements->haveValue(primvars[i].name)) there[i] = 0;
    slot.opaque = slot.program->isOpaqueWith(there);
    return slot;
}

std::shared_ptr<const Surface> DrawnSurfaces::find(const std::string& path) const {
    const auto found = _surfaces.find(path);
    return found == _surfaces.end() ? nullptr : found->second.surface;
}

std::vector<const Surface*> DrawnSurfaces::with(bool (*wanted)(const MaterialProgram&)) const {
    std::vector<const Surface*> result;
    for (const auto& item : _surfaces) {
        const Surface* surface = item.second.surface.get();
        if (surface && std::any_of(surface->materials.begin(), surface->materials.end(),
                                   [&](const MaterialSlot& slot) {
                                       return slot.program && wanted(*slot.program);
                                   }))
            result.push_back(surface);
    }
    return result;
}

void DrawnSurfaces::collectEmissive(const Placements& placements) {
    _counts.looked += _emitting.size();
    _emissive.clear();
    _sources.clear();
    bool inGroups = false;
    for (const auto& item : _emitting) {
        const auto& surface = item.second->surface;
        inGroups |= !surface->prim->group.empty();
        _emissive.push_back(surface.get());
        _sources.push_back(surface);
        for (const MaterialSlot& slot : surface->materials)
            _sources.push_back(slot.program);
    }
    const auto& instancers = placements.drawn();
    if (inGroups) _sources.insert(_sources.end(), instancers.begin(), instancers.end());
}

ScenePlan DrawnSurfaces::plan() const {
    ScenePlan plan;
    for (const auto& item : _programs)
        plan.add(item.first, item.second->planned());
    plan.add(subdivision.method);
    return plan;
}

std::map<const MaterialProgram*, std::string> DrawnSurfaces::materialNames() const {
    std::map<const MaterialProgram*, std::string> names;
    for (const auto& item : _programs)
        names[item.second.get()] = item.first;
    return names;
}

} // namespace patina

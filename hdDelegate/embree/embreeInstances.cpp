// SPDX-License-Identifier: Apache-2.0
// Instances of EmbreeScene: the tree of instancers as groups that Embree traces, and as transforms.

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <algorithm>

namespace patina {

std::shared_ptr<InstancerNode> EmbreeScene::node(const std::shared_ptr<const Instancer>& prim) {
    auto result = std::make_shared<InstancerNode>();
    result->prim = prim;
    result->values = _parts.placements->valuesOf(*prim);
    std::vector<std::vector<mat4>> sampled(prim->transforms.size());
    for (size_t i = 0; i < sampled.size(); ++i) {
        sampled[i] =
            resample(prim->transforms[i], _shutterOpen, _shutterClose, originOf(prim->group));
        result->steps = std::max(result->steps, int(sampled[i].size()));
    }
    result->transforms.resize(sampled.size() * result->steps);
    result->targets.assign(sampled.size(), nullptr);
    result->collapses.assign(sampled.size(), false);
    for (size_t i = 0; i < sampled.size(); ++i) {
        std::string problem;
        bool wide = true;
        float volumes[2] = {INFINITY, 0.0f}; // least and largest
        const auto measure = [&](const mat4& m) {
            const float volume = std::abs(glm::determinant(mat3(m)));
            volumes[0] = std::min(volumes[0], volume);
            volumes[1] = std::max(volumes[1], volume);
        };
        for (int s = 0; s < result->steps; ++s) {
            const mat4 m = transformAtStep(sampled[i], s, result->steps);
            result->transforms[i * result->steps + s] = m;
            if (problem.empty()) problem = inverseProblem(dmat4(m));
            wide &= isWideEnough(m);
            measure(m);
            if (s > 0)
                for (const float f : {0.25f, 0.5f, 0.75f})
                    measure(result->transforms[i * result->steps + s - 1] * (1.0f - f) + m * f);
        }
        // Half a turn from one step to the next, say: there is no inverse in the middle of it.
        result->collapses[i] = !wide || volumes[0] < 1e-3f * volumes[1];
        const int prototype = i < prim->prototypeIndices.size() ? prim->prototypeIndices[i] : -1;
        if (prototype < 0 || size_t(prototype) >= prim->prototypes.size()) {
            _diagnostics.warn(prim->path, "protoIndices", messages::prototypeOutOfRange);
            continue;
        }
        if (!problem.empty()) {
            _diagnostics.warn(prim->path, "transform", messages::instanceNotDrawn(problem));
            continue;
        }
        result->targets[i] = finishedGroup(prim->prototypes[prototype]);
    }
    for (const auto& names : prim->categories)
        result->categories.push_back(_parts.links->of(names));
    return result;
}

EmbreeGroup* EmbreeScene::finishedGroup(const std::string& name) const {
    return _finished.count(name) ? _groups.at(name).get() : nullptr;
}

std::shared_ptr<InstancerNode>
EmbreeScene::currentNode(const std::shared_ptr<const Instancer>& prim) {
    std::vector<uint64_t> versions;
    for (const std::string& name : prim->prototypes) {
        const EmbreeGroup* target = finishedGroup(name);
        versions.push_back(target ? target->version : 0);
    }
    std::shared_ptr<InstancerNode>& cached = _nodes[prim->path];
    if (!cached || cached->prim != prim || cached->versions != versions) {
        cached = node(prim);
        cached->versions = std::move(versions);
    }
    return cached;
}

EmbreeGroup* EmbreeScene::buildGroup(const std::string& name, int depth, const View& view) {
    if (EmbreeGroup* finished = finishedGroup(name)) return finished;
    if (depth > TraceContext::maxDepth || _building[name]) {
        _diagnostics.warn(name, "prototypes", messages::prototypeNests);
        return nullptr;
    }
    _building[name] = true;
    const Placements::Instancers& instancers = _parts.placements->in(name);
    for (const auto& instancer : instancers)
        for (const std::string& prototype : instancer->prototypes)
            buildGroup(prototype, depth + 1, view);
    if (view.stop) return nullptr; // versions tell the next update what this one did not reach
    std::vector<std::shared_ptr<InstancerNode>> nodes;
    for (const auto& instancer : instancers)
        nodes.push_back(currentNode(instancer));
    auto& group = _groups[name];
    if (!group) group = std::make_unique<EmbreeGroup>();
    group->name = name;
    if (view.changed) {
        const auto changed = view.changed->find(name);
        group->replace(_device,
                       changed == view.changed->end() ? EmbreeGroup::Surfaces() : changed->second,
                       &nodes, view.stop);
    } else {
        _counts.looked += _surfacesOf[name].size();
        group->update(_device, _surfacesOf[name], nodes, view.settings.interactive, view.stop);
    }
    if (group->changed) group->version = ++_groupVersion;
    _counts.groups += group->changed;
    _building[name] = false;
    _finished.insert(name);
    return group.get();
}

std::vector<const Surface*>
EmbreeScene::surfacesWith(bool (*wanted)(const MaterialProgram&)) const {
    std::vector<const Surface*> result;
    for (const auto& item : _surfaces) {
        const Surface* surface = item.second.surface.get();
        if (!surface) continue;
        for (const MaterialSlot& slot : surface->materials)
            if (slot.program && wanted(*slot.program)) {
                result.push_back(surface);
                break;
            }
    }
    return result;
}

void EmbreeScene::forTransforms(const std::string& group,
                                const std::function<void(const mat4&)>& visit) const {
    _parts.placements->forPlaces(
        group, mat4(1.0f),
        [&](const Instancer& instancer, uint32_t i, int, mat4& place) {
            place = interpolate(instancer.transforms[i], 0.0f, originOf(instancer.group)) * place;
            return true;
        },
        visit);
}

std::vector<mat4> EmbreeScene::groupTransforms(const std::string& group) const {
    std::vector<mat4> result;
    forTransforms(group, [&](const mat4& place) { result.push_back(place); });
    return result;
}

void EmbreeScene::updateVolumes(const View& view,
                                const std::vector<std::shared_ptr<const Volume>>& prims) {
    const auto mediumOf = [&](const std::shared_ptr<const Volume>& prim) {
        if (view.state.materials.count(prim->material)) program(prim->material, prim->path, view);
        return _compiled.volumes().medium(prim, view.state, view.settings);
    };
    _volumes.update(
        prims, mediumOf, [&](const std::string& group) { return groupTransforms(group); },
        _shutterOpen, _origin, _diagnostics);
}

void EmbreeScene::updateSplats(const View& view, const std::vector<SplatScene::Prim>& prims) {
    const auto placesOf = [&](const std::string& group) {
        std::vector<MovingPlace> places;
        _parts.placements->forPlaces(
            group, MovingPlace(),
            [&](const Instancer& instancer, uint32_t i, int, MovingPlace& place) {
                place.enter(resample(instancer.transforms[i], _shutterOpen, _shutterClose,
                                     originOf(instancer.group)));
                place.mask &= instancer.visibility.mask();
                if (instancer.marks.empty()) return true;
                place.mask &= instancer.marks[i].visibility.mask();
                place.matte |= instancer.marks[i].catching.matte;
                return true;
            },
            [&](const MovingPlace& place) { places.push_back(place); });
        return places;
    };
    _splats.update(_device, _compiled.splats(), prims, placesOf, _shutterOpen, _shutterClose,
                   _origin, *view.state.renderingSpace, view.stop, _diagnostics);
}

std::vector<GroupPlace> EmbreeScene::groupPlaces(const std::string& group) const {
    std::vector<GroupPlace> result;
    _parts.placements->forPlaces(
        group, GroupPlace(),
        [&](const Instancer& instancer, uint32_t i, int, GroupPlace& place) {
            place.toWorld = interpolate(instancer.transforms[i], 0.0f, originOf(instancer.group)) *
                            place.toWorld;
            place.steps.insert(place.steps.begin(),
                               {_parts.placements->valuesOf(instancer).get(), int(i)});
            return true;
        },
        [&](const GroupPlace& place) { result.push_back(place); });
    return result;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/groupTree.h"

#include "hdDelegate/scene/instancerCheck.h"

#include <algorithm>

namespace patina {

std::shared_ptr<InstancerNode> GroupTree::node(const SceneView& view,
                                               const std::shared_ptr<const Instancer>& prim) {
    auto result = std::make_shared<InstancerNode>();
    result->prim = prim;
    result->values = view.parts.placements->valuesOf(*prim);
    std::vector<std::vector<mat4>> sampled(prim->transforms.size());
    for (size_t i = 0; i < sampled.size(); ++i) {
        sampled[i] = view.space.steps(prim->transforms[i], prim->group);
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
        result->targets[i] = finished(prim->prototypes[prototype]);
    }
    for (const auto& names : prim->categories)
        result->categories.push_back(view.parts.links->of(names));
    return result;
}

EmbreeGroup* GroupTree::finished(const std::string& name) const {
    return _finished.count(name) ? _groups.at(name).get() : nullptr;
}

std::shared_ptr<InstancerNode>
GroupTree::currentNode(const SceneView& view, const std::shared_ptr<const Instancer>& prim) {
    std::vector<uint64_t> versions;
    for (const std::string& name : prim->prototypes) {
        const EmbreeGroup* target = finished(name);
        versions.push_back(target ? target->version : 0);
    }
    std::shared_ptr<InstancerNode>& cached = _nodes[prim->path];
    if (!cached || cached->prim != prim || cached->versions != versions) {
        cached = node(view, prim);
        cached->versions = std::move(versions);
    }
    return cached;
}

void GroupTree::noteChange(EmbreeGroup& group) {
    if (!group.changed) return;
    group.version = ++_version;
    ++_counts.groups;
}

void GroupTree::replace(const Build& build, EmbreeGroup& group, const EmbreeGroup::Nodes* nodes) {
    const auto changed = build.surfaces.find(group.name);
    group.replace(build.device,
                  changed == build.surfaces.end() ? EmbreeGroup::Surfaces() : changed->second,
                  nodes, build.view.stop);
}

EmbreeGroup* GroupTree::group(const Build& build, const std::string& name, int depth) {
    if (EmbreeGroup* known = finished(name)) return known;
    if (depth > TraceContext::maxDepth || _building.count(name)) {
        _diagnostics.warn(name, "prototypes", messages::prototypeNests);
        return nullptr;
    }
    _building.insert(name);
    const Placements::Instancers& instancers = build.view.parts.placements->in(name);
    for (const auto& instancer : instancers)
        for (const std::string& prototype : instancer->prototypes)
            group(build, prototype, depth + 1);
    if (build.view.stop) return nullptr; // versions tell the next build what this one left out
    EmbreeGroup::Nodes nodes;
    for (const auto& instancer : instancers)
        nodes.push_back(currentNode(build.view, instancer));
    auto& made = _groups[name];
    if (!made) made = std::make_unique<EmbreeGroup>();
    made->name = name;
    if (build.onlyChanged) {
        replace(build, *made, &nodes);
    } else {
        const auto found = build.surfaces.find(name);
        const auto members =
            found == build.surfaces.end() ? EmbreeGroup::Surfaces() : found->second;
        _counts.looked += members.size();
        const RenderSettings& settings = build.view.settings;
        made->update(build.device, members, nodes,
                     settings.compactGeometry ? EmbreeGroup::Structure::Compact
                     : settings.interactive   ? EmbreeGroup::Structure::Editable
                                              : EmbreeGroup::Structure::Fast,
                     build.view.stop);
    }
    noteChange(*made);
    _building.erase(name);
    _finished.insert(name);
    return made.get();
}

EmbreeGroup* GroupTree::build(RTCDevice device, const SceneView& view, const Members& surfaces) {
    _building.clear();
    _finished.clear();
    for (auto& item : _nodes) // light links may have other numbers
        for (size_t i = 0; i < item.second->categories.size(); ++i)
            item.second->categories[i] = view.parts.links->of(item.second->prim->categories[i]);
    EmbreeGroup* world = group({device, view, surfaces, false}, "", 0);
    if (view.stop) return nullptr;
    for (auto it = _groups.begin(); it != _groups.end();)
        it = _finished.count(it->first) ? std::next(it) : _groups.erase(it);
    for (auto it = _nodes.begin(); it != _nodes.end();)
        it = view.state.instancers.count(it->first) ? std::next(it) : _nodes.erase(it);
    _instanceCount = 0;
    for (const std::string& name : _finished)
        for (const auto& instancer : view.parts.placements->in(name))
            _instanceCount += instancer->transforms.size();
    return world;
}

EmbreeGroup* GroupTree::rebuild(RTCDevice device, const SceneView& view, const Members& changed) {
    const Build build{device, view, changed, true};
    if (changed.size() == 1 && changed.begin()->first.empty()) {
        EmbreeGroup& world = *_groups.at("");
        replace(build, world, nullptr);
        noteChange(world);
        return &world;
    }
    // Instances of what has changed are attached anew, up to the world.
    std::vector<std::string> left;
    for (const auto& item : changed)
        left.push_back(item.first);
    while (!left.empty()) {
        const std::string name = std::move(left.back());
        left.pop_back();
        if (_finished.erase(name) == 0) continue;
        for (const Placements::Use& use : view.parts.placements->of(name))
            left.push_back(use.instancer->group);
    }
    _building.clear();
    return group(build, "", 0);
}

void GroupTree::clear() {
    _nodes.clear();
    _groups.clear();
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/matteNames.h"

namespace patina {

namespace {

constexpr char nobody[] = "default";

const std::string& at(const std::vector<std::string>& names, int instance) {
    static const std::string none;
    return instance >= 0 && size_t(instance) < names.size() ? names[size_t(instance)] : none;
}

/// The name of a group that an instance shows.
const std::string& groupOf(const Instancer& instancer, int instance) {
    static const std::string none;
    if (instance < 0 || size_t(instance) >= instancer.prototypeIndices.size()) return none;
    const int prototype = instancer.prototypeIndices[size_t(instance)];
    return prototype >= 0 && size_t(prototype) < instancer.prototypes.size()
               ? instancer.prototypes[size_t(prototype)]
               : none;
}

/// Whether a path is a group's, or below.
bool isBelow(const std::string& path, const std::string& group) {
    return !group.empty() && path.compare(0, group.size(), group) == 0 &&
           (path.size() == group.size() || path[group.size()] == '/');
}

/// @returns a path of the inside of an instance as it is called around it
std::string seenFromOutside(std::string path, const InstanceStep& step, bool numbered) {
    if (!step.values) return path;
    const Instancer& instancer = step.values->instancer();
    const std::string& name = at(instancer.names, step.instance);
    const std::string& group = groupOf(instancer, step.instance);
    if (!name.empty() && isBelow(path, group)) return name + path.substr(group.size());
    if (!name.empty() || !numbered) return path;
    const auto& ids = instancer.ids;
    const size_t i = size_t(step.instance);
    return path + "[" + std::to_string(i < ids.size() ? ids[i] : step.instance) + "]";
}

} // namespace

std::string objectMatte(const Geometry& prim, const InstanceStep* steps, int count) {
    if (!prim.matteName.empty()) return prim.matteName;
    for (int i = count - 1; i >= 0; --i)
        if (const Marked* marks = steps[i].marks(); marks && !marks->matteName.empty())
            return marks->matteName;
    std::string name = prim.path;
    for (int i = count - 1; i >= 0; --i)
        name = seenFromOutside(std::move(name), steps[i], true);
    return name;
}

std::string assetMatte(const Geometry& prim, const InstanceStep* steps, int count) {
    std::string name = prim.assetName;
    for (int i = count - 1; i >= 0; --i) {
        if (const Marked* marks = steps[i].marks(); name.empty() && marks) name = marks->assetName;
        if (!name.empty()) {
            name = seenFromOutside(std::move(name), steps[i], false);
        } else if (steps[i].values) {
            const Instancer& instancer = steps[i].values->instancer();
            name = instancer.assets.empty() ? instancer.assetName
                                            : at(instancer.assets, steps[i].instance);
        }
    }
    return name.empty() ? nobody : name;
}

std::string materialMatte(const Geometry& prim, size_t slot) {
    const std::string& path = slot == 0                        ? prim.material
                              : slot - 1 < prim.subsets.size() ? prim.subsets[slot - 1].material
                                                               : prim.material;
    return path.empty() ? nobody : path;
}

} // namespace patina

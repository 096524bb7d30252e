// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/instances.h"

#include "hdDelegate/hydra/renderParam.h"

#include <pxr/base/tf/stringUtils.h>

namespace patina {

namespace {

/// FNV-1a, so that a group's name says which instances it has.
uint64_t hashOf(const VtIntArray& indices) {
    uint64_t hash = 14695981039346656037ull;
    for (const int index : indices)
        for (int byte = 0; byte < 4; ++byte)
            hash = (hash ^ (uint32_t(index) >> (8 * byte) & 255u)) * 1099511628211ull;
    return hash;
}

} // namespace

std::string HdPatinaInstances::place(const SdfPath& prototype, const SdfPath& instancer,
                                     const VtIntArray& indices) {
    const std::string group = TfStringPrintf("%s[%zu:%016llx]", instancer.GetText(), indices.size(),
                                             static_cast<unsigned long long>(hashOf(indices)));
    std::lock_guard<std::mutex> lock(_mutex);
    const auto before = _places.find(prototype);
    if (before != _places.end() && before->second.group == group) return group;
    leaveLocked(prototype);
    _places[prototype] = {instancer, group};
    Entry& entry = _entries[instancer];
    Group& own = entry.groups[group];
    if (own.members++ == 0) {
        own.indices.assign(indices.begin(), indices.end());
        entry.changed = true;
    }
    return group;
}

void HdPatinaInstances::leave(const SdfPath& prototype) {
    std::lock_guard<std::mutex> lock(_mutex);
    leaveLocked(prototype);
}

void HdPatinaInstances::leaveLocked(const SdfPath& prototype) {
    const auto place = _places.find(prototype);
    if (place == _places.end()) return;
    const auto entry = _entries.find(place->second.instancer);
    if (entry != _entries.end()) {
        const auto group = entry->second.groups.find(place->second.group);
        if (group != entry->second.groups.end() && --group->second.members == 0) {
            entry->second.groups.erase(group);
            entry->second.changed = true;
        }
    }
    _places.erase(place);
}

void HdPatinaInstances::setInstancer(const SdfPath& instancer, const std::string& group,
                                     std::shared_ptr<const HdPatinaInstanceData> data) {
    std::lock_guard<std::mutex> lock(_mutex);
    Entry& entry = _entries[instancer];
    entry.known = true;
    entry.group = group;
    entry.data = std::move(data);
    entry.changed = true;
}

void HdPatinaInstances::removeInstancer(const SdfPath& instancer) {
    std::lock_guard<std::mutex> lock(_mutex);
    leaveLocked(instancer);
    Entry& entry = _entries[instancer];
    entry.known = false;
    entry.data.reset();
    entry.changed = true;
}

SdfPathVector HdPatinaInstances::instancers() {
    std::lock_guard<std::mutex> lock(_mutex);
    SdfPathVector paths;
    for (const auto& item : _entries)
        if (item.second.known) paths.push_back(item.first);
    return paths;
}

void HdPatinaInstances::flush(HdPatinaRenderParam& param) {
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto it = _entries.begin(); it != _entries.end();) {
        Entry& entry = it->second;
        if (entry.changed) {
            entry.changed = false;
            if (entry.known && entry.data && !entry.groups.empty()) {
                param.set(build(it->first, entry, param));
                entry.inScene = true;
            } else if (entry.inScene) {
                param.removeInstancer(it->first.GetString());
                entry.inScene = false;
            }
        }
        const bool gone = !entry.known && entry.groups.empty();
        it = gone ? _entries.erase(it) : std::next(it);
    }
}

std::shared_ptr<const Instancer> HdPatinaInstances::build(const SdfPath& path, const Entry& entry,
                                                          HdPatinaRenderParam& param) const {
    const HdPatinaInstanceData& data = *entry.data;
    auto result = std::make_shared<Instancer>();
    result->path = path.GetString();
    result->group = entry.group;
    result->visibility = Visibility::all(data.visible);
    std::vector<int> sources; // index of each instance
    for (const auto& item : entry.groups) {
        if (item.second.indices.empty()) continue; // placed, but drawn nowhere
        const int prototype = int(result->prototypes.size());
        result->prototypes.push_back(item.first);
        result->idCounts.push_back(int(item.second.indices.size()));
        for (size_t ordinal = 0; ordinal < item.second.indices.size(); ++ordinal) {
            const int index = item.second.indices[ordinal];
            if (index < 0 || size_t(index) >= data.transforms.size()) {
                param.warn(path, "instanceIndices", messages::instancesWithoutTransform);
                continue;
            }
            result->prototypeIndices.push_back(prototype);
            result->transforms.push_back(data.transforms[size_t(index)]);
            result->ids.push_back(int(ordinal));
            sources.push_back(index);
        }
    }
    if (!data.categories.empty())
        for (const int index : sources)
            result->categories.push_back(size_t(index) < data.categories.size()
                                             ? data.categories[size_t(index)]
                                             : std::vector<std::string>());
    if (!data.marks.empty())
        for (const int index : sources)
            result->marks.push_back(data.marks[size_t(index)]);
    for (const Primvar& primvar : data.primvars) {
        Primvar own = primvar;
        if (primvar.interpolation != Interpolation::Constant) {
            const size_t n = size_t(primvar.components);
            own.values.clear();
            for (const int index : sources)
                for (size_t k = 0; k < n; ++k) {
                    const size_t i = size_t(index) * n + k;
                    own.values.push_back(i < primvar.values.size() ? primvar.values[i] : 0.0f);
                }
        }
        result->primvars.push_back(std::move(own));
    }
    return result;
}

} // namespace patina

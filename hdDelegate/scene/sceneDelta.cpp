// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/sceneDelta.h"

#include <algorithm>
#include <utility>

namespace patina {

namespace {

void append(SceneDelta::Paths& paths, const SceneDelta::Paths& later) {
    for (const auto& [path, edit] : later) {
        const auto [known, isNew] = paths.emplace(path, edit);
        if (isNew) continue;
        const bool wasThere = known->second == PrimEdit::Set || known->second == PrimEdit::Removed;
        const bool isThere = edit == PrimEdit::Set || edit == PrimEdit::Added;
        known->second = wasThere ? (isThere ? PrimEdit::Set : PrimEdit::Removed)
                                 : (isThere ? PrimEdit::Added : PrimEdit::Passing);
    }
}

} // namespace

bool onlySets(const SceneDelta::Paths& paths) {
    return std::all_of(paths.begin(), paths.end(),
                       [](const auto& item) { return item.second == PrimEdit::Set; });
}

size_t SceneDelta::size() const {
    return geometry.size() + instancers.size() + lights.size() + cameras.size() + materials.size();
}

void SceneDelta::add(const SceneDelta& later) {
    append(geometry, later.geometry);
    append(instancers, later.instancers);
    append(lights, later.lights);
    append(cameras, later.cameras);
    append(materials, later.materials);
    metersPerUnit |= later.metersPerUnit;
}

void EditLog::add(uint64_t version, SceneDelta delta) {
    _last = version;
    _paths += delta.size();
    _deltas.push_back(std::move(delta));
    while (_deltas.size() > maxCommits || (_paths > maxPaths && !_deltas.empty())) {
        _paths -= _deltas.front().size();
        _deltas.pop_front();
    }
}

void EditLog::clear() {
    _deltas.clear();
    _paths = 0;
}

std::optional<SceneDelta> EditLog::between(uint64_t from, uint64_t to) const {
    if (from == to) return SceneDelta();
    // The first delta leads to version _last + 1 - size, from the one before.
    if (from > to || to > _last || from + _deltas.size() < _last) return std::nullopt;
    const size_t first = size_t(from + _deltas.size() - _last);
    SceneDelta result;
    for (size_t i = first; i < first + size_t(to - from); ++i)
        result.add(_deltas[i]);
    return result;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

namespace patina {

/// The change of a prim between two states.
enum class PrimEdit {
    Set,     ///< it is another object
    Added,   ///< it was not there before
    Removed, ///< it is not there any more
    Passing, ///< it came and went: it was not there before and is not now
};

/// The difference of two states of a scene: paths by kind, without the prims, so that none is
/// kept alive.
struct SceneDelta {
    using Paths = std::map<std::string, PrimEdit>;

    Paths geometry, instancers, lights, cameras, materials;
    bool metersPerUnit = false;

    size_t size() const;
    bool empty() const { return size() == 0 && !metersPerUnit; }
    /// Goes on with what happened after it.
    void add(const SceneDelta& later);
};

/// Whether no prim came or went.
bool onlySets(const SceneDelta::Paths& paths);

/// The latest deltas of a scene by the version that each led to. It forgets the oldest beyond its
/// limits, and whoever comes from before them has to look at everything.
class EditLog {
public:
    static constexpr size_t maxCommits = 256;
    static constexpr size_t maxPaths = 16384; ///< of all of them

    /// @param version one more than that of the call before
    void add(uint64_t version, SceneDelta delta);
    /// The difference is not known: everything may have changed.
    void clear();
    /// The difference of two versions.
    /// @returns nothing where that is not known any more, or `from` is the later one
    std::optional<SceneDelta> between(uint64_t from, uint64_t to) const;

private:
    std::deque<SceneDelta> _deltas;
    uint64_t _last = 0; ///< version of the last delta
    size_t _paths = 0;
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "hdDelegate/scene/primMap.h"
#include "base/diagnostics.h"
#include "base/limits.h"

namespace patina {

/// A prim's count for Limit::triangles: triangles at its refine level, or points of curves,
/// points and splats. A subdivision surface counts at most what its tessellation may refine it to.
uint64_t trianglesOf(const Geometry& prim);
template <class T> uint64_t trianglesOf(const T&) {
    return 0;
}

/// Takes out of the changes to the prims of one kind what would leave a scene beyond its limits;
/// of what is new the first paths stay. One message names the first prim that is left out.
class SceneLimits {
public:
    /// @param triangles of the scene before the changes; receives those after them
    SceneLimits(uint64_t& triangles, Diagnostics& diagnostics)
        : _triangles(triangles), _diagnostics(diagnostics) {}
    ~SceneLimits() { report(); }

    template <class T> void keep(const PrimMap<T>& prims, typename PrimMap<T>::Changes& changes) {
        size_t count = prims.size();
        for (const auto& [path, after] : changes) { // what goes makes room first
            const auto before = prims.find(path);
            if (before == prims.end()) continue;
            _triangles -= trianglesOf(*before->second);
            --count;
        }
        for (auto& [path, after] : changes)
            if (after && !takes(path, count, trianglesOf(*after))) after = nullptr;
    }

private:
    bool takes(const std::string& path, size_t& count, uint64_t triangles);
    void report();

    struct Refused {
        Limit limit;
        const char* what;
        std::string first;
        size_t count = 0;
    };
    uint64_t& _triangles;
    Diagnostics& _diagnostics;
    Refused _refused[3] = {{Limit::textLength, "bytes in a path", {}},
                           {Limit::prims, "prims of a kind", {}},
                           {Limit::triangles, "triangles", {}}};
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <cmath>
#include <vector>

namespace patina {

/// Light that has come to a surface through glass.
struct Photon {
    vec3 position{0.0f}; ///< world space
    vec3 towards{0.0f};  ///< unit, where it came from
    vec3 normal{0.0f};   ///< of the surface's geometry, on the side that it came to
    vec3 flux{0.0f};     ///< over the number of photons that were sent out; 0: it came nowhere
    int bounces = 0;     ///< surfaces of glass on its way
    int axis = 0;        ///< that PhotonMap splits space along here
};

/// Photons in a balanced k-d tree (Jensen 2001): the middle one of a range is its root, the ranges
/// before and after it are the subtrees. Immutable; equal photons give equal trees.
class PhotonMap {
public:
    PhotonMap() = default;
    /// @param photons those without flux are left out
    explicit PhotonMap(std::vector<Photon> photons);

    bool empty() const { return _photons.empty(); }
    size_t size() const { return _photons.size(); }

    /// Calls body(photon) for each photon nearer to a point than a radius, in the tree's order.
    template <class Body> void visit(const vec3& point, float radius, const Body& body) const {
        struct Range {
            size_t begin, end;
        };
        Range ranges[64]; // a range of each level waits at most
        int count = 0;
        if (!_photons.empty()) ranges[count++] = {0, _photons.size()};
        while (count > 0) {
            const Range range = ranges[--count];
            const size_t middle = (range.begin + range.end) / 2;
            const Photon& photon = _photons[middle];
            const vec3 d = point - photon.position;
            if (glm::dot(d, d) < radius * radius) body(photon);
            const float side = d[photon.axis];
            if (side > -radius && middle + 1 < range.end) ranges[count++] = {middle + 1, range.end};
            if (side < radius && range.begin < middle) ranges[count++] = {range.begin, middle};
        }
    }

private:
    void split(size_t begin, size_t end);

    std::vector<Photon> _photons;
};

} // namespace patina

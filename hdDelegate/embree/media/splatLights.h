// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/splatKernels.h"

#include <array>

namespace patina {

/// Splats as what lights surfaces: spheres around clusters of kernels, into which directions are
/// drawn. Immutable between updates.
class SplatLights {
public:
    static constexpr size_t most = 32; ///< clusters of a scene; with more places there are none

    void clear() { _clusters.clear(); }
    /// @param places of all fields, among which the clusters are divided
    void add(const SplatKernels& kernels, const mat4& toWorld, size_t places);
    bool empty() const { return _clusters.empty(); }

    struct Direction {
        vec3 direction{0.0f};
        float pdf = 0.0f; ///< by solid angle; 0: there is none to draw
    };
    /// @param normal of a surface that is lit on this side
    Direction sample(const vec3& point, const vec3& normal, const vec3& u) const;
    float pdf(const vec3& point, const vec3& normal, const vec3& direction) const;

private:
    struct Cluster {
        vec3 center{0.0f};
        float radius = 0.0f, flux = 0.0f; ///< flux: in relation to other clusters
    };
    /// Of a cluster as a point sees it.
    struct Cone {
        vec3 axis{0.0f};
        float versine = 0.0f; ///< 1 - cosine of its half angle
        float chance = 0.0f;
    };
    using Cones = std::array<Cone, most>;
    /// @returns whether there are any
    bool cones(const vec3& point, const vec3& normal, Cones& cones) const;
    float density(const Cones& cones, const vec3& direction) const;

    std::vector<Cluster> _clusters;
};

} // namespace patina

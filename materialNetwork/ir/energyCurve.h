// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace patina {

struct BsdfLobe;

/// Albedo and energy factors of a rough isotropic interface whose parameters are constant, over the
/// cosine of wo on the outside. The baked tables hang on roughness and ior too and cost several
/// logarithms and powers per look-up; most materials are constant, and this costs two roots.
class EnergyCurve {
public:
    static constexpr int nodeCount = 64;
    static constexpr int fineCount = 512;

    /// Measures the lobe (cpu/energyCurve.cpp). The curve stays empty for lobes that it does not
    /// suit: mirrors and nearly mirrors, anisotropic lobes, and interfaces that are denser on the
    /// outside (total reflection has a kink). Methods that sum over many facets (ALBEDO_SAMPLES_16
    /// and above) are too slow to evaluate at every point. They get a fine curve, read by cubics,
    /// for any roughness, for conductors, and for the inner side too.
    void measure(const BsdfLobe& lobe);
    bool empty() const { return _nodes.empty() && _fine.empty(); }
    /// Whether at() knows light from this side.
    bool covers(float z) const { return z >= 0.0f ? !empty() : !_below.empty(); }

    struct Energy {
        glm::vec3 kr, kt; ///< factors of shaders/lib/energy.glsl
        glm::vec3 r, t;   ///< albedo of reflection and transmission, without tint
    };
    /// @param z cosine of wo, of a side that is covered. Of a conductor only kr counts.
    Energy at(float z) const;
    /// nodeCount of them, evenly spaced in the fourth root of the cosine, for reading by lines;
    /// none where that is not good enough.
    const std::vector<Energy>& nodes() const { return _nodes; }

private:
    std::vector<Energy> _nodes, _fine, _below;
};

} // namespace patina

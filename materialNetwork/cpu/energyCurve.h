#pragma once

#include "materialNetwork/cpu/bsdf.h"

#include <vector>

namespace patina {

/// Albedo and energy factors of a rough isotropic interface whose parameters are constant, over the
/// cosine of wo on the outside. The baked tables hang on roughness and ior too and cost several
/// logarithms and powers per look-up; most materials are constant, and this costs two roots.
class EnergyCurve {
public:
    static constexpr int nodeCount = 64;

    /// Measures the lobe. Stays empty for lobes that it does not suit: mirrors and lobes
    /// nearly as narrow, anisotropic ones, interfaces that are denser on the outside (total
    /// reflection has a kink).
    void measure(const BsdfLobe& lobe);
    bool empty() const { return _nodes.empty(); }

    struct Energy {
        glm::vec3 kr, kt; ///< factors of shaders/lib/energy.glsl
        glm::vec3 r, t;   ///< albedo of reflection and transmission, without tint
    };
    /// @param z cosine of wo, not negative
    Energy at(float z) const;
    /// nodeCount of them, evenly spaced in the fourth root of the cosine; none when empty.
    const std::vector<Energy>& nodes() const { return _nodes; }

private:
    std::vector<Energy> _nodes;
};

/// The same, directly from the baked tables. For dielectric and Schlick lobes.
EnergyCurve::Energy lobeEnergy(const BsdfLobe& lobe, const glm::vec3& wo);

} // namespace patina

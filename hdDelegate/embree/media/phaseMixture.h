#pragma once

#include "materialNetwork/cpu/medium.h"

#include <glm/glm.hpp>

namespace patina {

/// The phase function of a medium, seen by a path: the parts of the medium weighted by how much
/// each scatters, sampled in proportion to what they add to the path's throughput.
class PhaseMixture {
public:
    PhaseMixture(const Medium& medium, const glm::vec3& throughput);

    /// @param wo,wi world space, unit, away from the point
    /// @param pdf density with which sample() finds wi
    /// @returns the phase function per channel, normalised to 1
    glm::vec3 eval(const glm::vec3& wo, const glm::vec3& wi, float& pdf) const;

    struct Sample {
        glm::vec3 wi{0.0f}, weight{0.0f};
        float pdf = 0.0f;
    };
    /// @param u direction; uPart which part; in [0, 1)
    Sample sample(const glm::vec3& wo, const glm::vec2& u, float uPart) const;

private:
    struct Part {
        glm::vec3 share; ///< of the scattering, per channel; the parts sum to 1 or 0
        float anisotropy, probability;
    };
    Part _parts[Medium::maxPhases];
    int _count = 0;
};

} // namespace patina

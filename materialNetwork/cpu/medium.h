#pragma once

#include <glm/glm.hpp>

namespace patina {

/// A participating medium at one point: what a VDF says. All coefficients are per scene unit,
/// finite and not negative.
///
/// The scattering is a sum of Henyey-Greenstein parts, so that an added or mixed VDF keeps the
/// phase functions that it is made of.
struct Medium {
    static constexpr int maxPhases = 4;
    /// Coefficients are held below this, so that products of them stay finite.
    static constexpr float maxCoefficient = 1e15f;

    struct Phase {
        glm::vec3 scattering{0.0f};
        float anisotropy = 0.0f; ///< mean cosine, -1..1
    };

    glm::vec3 absorption{0.0f};
    glm::vec3 emission{0.0f}; ///< radiance gained per scene unit
    Phase phases[maxPhases];
    int phaseCount = 0;

    glm::vec3 scattering() const {
        glm::vec3 sum(0.0f);
        for (int i = 0; i < phaseCount; ++i)
            sum += phases[i].scattering;
        return sum;
    }
    glm::vec3 extinction() const { return absorption + scattering(); }
    bool scatters() const { return phaseCount > 0; }
    bool empty() const {
        return phaseCount == 0 && absorption == glm::vec3(0.0f) && emission == glm::vec3(0.0f);
    }

    /// Adds scattering. Of more than maxPhases different parts the last two become one, with the
    /// mean anisotropy of both.
    void addScattering(const glm::vec3& scattering, float anisotropy);
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <functional>

namespace patina {

/// The light of a sky on diffuse surfaces: its irradiance as spherical harmonics of order 2
/// (Ramamoorthi and Hanrahan 2001), and its one dominant light, if it has one, apart from them.
struct SkyHarmonics {
    glm::vec3 irradiance[9]; ///< coefficients of the irradiance, in the order of shHarmonics()
    glm::vec3 sunDirection{0.0f, 1.0f, 0.0f};
    glm::vec3 sunIrradiance{0.0f}; ///< on a plane that faces it; zero without a dominant light
    float window = 0.0f;           ///< lambda of the window in force, 0 for none

    /// On a surface with this normal, without the dominant light.
    glm::vec3 at(const glm::vec3& normal) const;
};

/// The nine functions in a direction (Green 2003), constants included.
void shHarmonics(const glm::vec3& direction, float out[9]);

/// Projects a sky by summing over the cells of a latlong grid of 256 by 128, with 36 directions in
/// each cell.
///
/// If the light within 6 degrees of the brightest direction, above the level around it, is at least
/// a tenth of all flux, it becomes a directional light. The rest is windowed by 1 / (1 + lambda l^2
/// (l + 1)^2) (Sloan 2008), with the smallest lambda that keeps the irradiance from ringing below
/// zero anywhere.
/// @param radiance of a direction; negative and not finite values count as zero
/// @param splitSun false keeps all of it in the harmonics
/// @param windows false leaves the harmonics as they are: bright spots then ring, with negative
///        light behind them
SkyHarmonics makeSkyHarmonics(const std::function<glm::vec3(const glm::vec3&)>& radiance,
                              bool splitSun = true, bool windows = true);

} // namespace patina

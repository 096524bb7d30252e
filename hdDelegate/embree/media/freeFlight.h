// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace patina {

/// Share of light left after `distance` (Beer and Lambert). Channels that are clear stay clear over
/// an infinite distance.
glm::vec3 transmittance(const glm::vec3& extinction, float distance);

/// Radiance that a homogeneous medium gives off along `distance`, seen through itself.
glm::vec3 emissionAlong(const glm::vec3& emission, const glm::vec3& extinction, float distance);

/// How far light goes in a homogeneous medium before it scatters.
struct FreeFlight {
    float distance = 0.0f;
    bool scattered = false; ///< false: it arrives at the end of the way
    glm::vec3 weight{1.0f}; ///< scattered: scattering * transmittance / density; else transmittance
                            ///< over the chance to arrive
};

/// Samples a distance. One channel is chosen in proportion to the throughput and its extinction
/// sampled; the weight is that of the balance heuristic over all channels (the single-sample model
/// of Veach 1997, chapter 9; for media Wilkie et al. 2014), so it is bounded in every channel.
/// @param throughput of the path so far
/// @param end length of the way, may be infinite
/// @param u x chooses the channel, y the distance; in [0, 1)
FreeFlight sampleFreeFlight(const glm::vec3& extinction, const glm::vec3& scattering,
                            const glm::vec3& throughput, float end, const glm::vec2& u);

/// The flight that sampleFreeFlight() would have returned for this outcome: for a way whose end is
/// found only after the distance is sampled.
FreeFlight weighFreeFlight(const glm::vec3& extinction, const glm::vec3& scattering,
                           const glm::vec3& throughput, float distance, bool scattered);

} // namespace patina

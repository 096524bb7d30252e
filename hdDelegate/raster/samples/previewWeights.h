// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace patina {

/// A sample of a dome: its direction (of length 1), and its light divided by its density.
struct DomeSample {
    glm::vec3 direction{0.0f}, light{0.0f};
};

/// Few samples that light as many do: factors of their light, by channel, near 1, so that their
/// mean has the spherical harmonics up to degree 2 of the mean of all, which are nearly all that
/// diffuse surfaces tell apart (Ramamoorthi and Hanrahan 2001). Not below 0.2 nor above 5.
/// @returns one for each of `few`; 1 where there are too few to choose from
std::vector<glm::vec3> previewWeights(const std::vector<DomeSample>& few,
                                      const std::vector<DomeSample>& all);

} // namespace patina

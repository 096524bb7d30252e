// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/hashedNumbers.h"
#include "shaders/shaders.h"

namespace patina {

/// The facets of a Smith surface as rays inside it meet them, from above and from below. Heights
/// enter only as the share of the surface that is lower, so their distribution does not matter.
class SmithSurface {
public:
    /// @param alpha not that of a mirror; @param ndf sh::NDF_*
    SmithSurface(const glm::vec2& alpha, int ndf) : _alpha(alpha), _ndf(ndf) {}

    /// @returns projected area of the facets that v sees, per area of the surface; v may look up
    /// from below
    double projectedArea(const glm::vec3& v) const;

    /// @returns share of the surface below where a ray along w that starts at `below` meets it;
    /// above 1 when it leaves
    double nextBelow(const glm::vec3& w, double below, double u) const;

    /// @returns the chance that a ray along w, from `below`, leaves
    double leaves(const glm::vec3& w, double below) const;

    /// Draws a facet in proportion to what v sees of it.
    glm::vec3 sampleVisibleNormal(const glm::vec3& v, const glm::vec2& u,
                                  HashedNumbers& random) const;

    /// Density of directions i that such facets reflect v to, per solid angle.
    double reflected(const glm::vec3& v, const glm::vec3& i, float& cosine) const;

    /// The same for refraction. @param eta ior of i's side over that of v's
    double refracted(const glm::vec3& v, const glm::vec3& i, float eta, float& cosine) const;

private:
    /// Signed so that both ways have one formula: Lambda(-w) = -1 - Lambda(w).
    double lambda(const glm::vec3& w) const;
    glm::vec3 beckmannFromBelow(const glm::vec3& v, HashedNumbers& random) const;

    glm::vec2 _alpha;
    int _ndf;
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "shaders/oracle.h"

namespace patina::measure {

/// The result of a walk on the microsurface.
struct Walked {
    double all = 0.0;   ///< share of light that comes back, however often it bounced
    double once = 0.0;  ///< of that, after one bounce
    double sigma = 0.0; ///< standard error of `all`
    double walks = 0.0;
};

/// Random walks of light between the facets of a Smith surface with uniform heights (Heitz et al.
/// 2016, "Multiple-Scattering Microfacet BSDFs with the Smith Model", section 4): the truth for
/// energy compensation. Slow, and exact but for noise.
/// @param wo      above the surface
/// @param alpha   not that of a mirror
/// @param ndf  sh::NDF_*
/// @param reflectance  of a facet, from the cosine to its normal
Walked walkMicrosurface(sh64::vec3 wo, sh64::vec2 alpha, int ndf,
                        const std::function<double(double)>& reflectance, int walks,
                        std::uint64_t seed);

} // namespace patina::measure

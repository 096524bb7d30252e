// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <vector>

namespace patina {

/// Wavelengths of light, drawn in proportion to the mean of what the three channels see of each.
///
/// A channel's sensitivity is that of linear Rec.709 to one wavelength (sh::filmChannels). Where it
/// is negative it counts as 0, and the rest is scaled to sum to 1: light of one wavelength shows at
/// the edge of the gamut that it lies outside of, no path counts negative, and what all wavelengths
/// have in common stays as it is.
class Wavelengths {
public:
    static const Wavelengths& get();

    struct Drawn {
        float nm;
        vec3 weight; ///< sensitivity over density: 1 in the mean of each channel, 3 at most
    };
    /// @param u in [0, 1); wavelengths grow with it
    Drawn draw(float u) const;

    /// @returns the sensitivity of each channel over the bin of 1 nm around, per nm
    vec3 sensitivity(float nm) const;

private:
    Wavelengths();

    std::vector<vec3> _sensitivity; ///< per bin
    std::vector<float> _below;      ///< chance of all bins before, and 1 at the end
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"
#include "materialNetwork/color/colorSpaces.h"

#include <vector>

namespace patina {

/// Wavelengths of light, drawn in proportion to the mean of the three channels' sensitivities.
///
/// The sensitivity of a channel is that of the rendering space to one wavelength
/// (sh::filmChannels), with negative parts set to 0 and the rest scaled to sum to 1. So light of
/// one wavelength outside of the gamut shows at the gamut's edge, no path counts negative, and
/// light whose wavelengths all stay together keeps its colour.
class Wavelengths {
public:
    static const Wavelengths& of(const RenderingSpace& space = RenderingSpace::rec709());

    struct Drawn {
        float nm;
        vec3 weight; ///< sensitivity over density: 1 in the mean of each channel, 3 at most
    };
    /// @param u in [0, 1); wavelengths grow with it
    Drawn draw(float u) const;

    /// @returns the sensitivity of each channel over the bin of 1 nm around, per nm
    vec3 sensitivity(float nm) const;

private:
    explicit Wavelengths(const RenderingSpace& space);

    std::vector<vec3> _sensitivity; ///< per bin
    std::vector<float> _below;      ///< chance of all bins before, and 1 at the end
};

} // namespace patina

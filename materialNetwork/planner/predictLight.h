// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/planner/planProbes.h"

#include <string>

namespace patina {

/// The table's prediction for a method of `domeLight` or `areaLight` on a material under one kind
/// of light.
struct LightPrediction {
    bool measured = false; ///< false where the material has lobes that no row is of
    double error = 0.0;    ///< relative luminance of the light that the method is for
    double ns = 0.0;       ///< per evaluation of all lobes
};

/// Errors count by the lobes' shares of the light; of the quarters of the cosine the mean and the
/// worst count half each, of places with different parameters the worst.
/// @param light of the row's subject, after the kind of lobe: `soft`, `sun`, `rect`, ...
/// @param count how often, as the subject ends: `16 passes`; empty: once
LightPrediction predictLight(const std::vector<std::vector<DirectionProbe>>& places,
                             const std::string& point, const std::string& method,
                             const std::string& light, const std::string& count);

} // namespace patina

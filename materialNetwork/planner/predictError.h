// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/plan/plan.h"
#include "materialNetwork/planner/planProbes.h"

#include <string>

namespace patina {

/// Error and cost of a method on a material, by the table.
struct Prediction {
    bool measured = false;
    double error = 0.0; ///< relative luminance, light that has met one surface
    double noise = 0.0; ///< of methods that have noise alone: standard deviation of a sample
    double ns = 0.0;    ///< per evaluation of the lobes that the method concerns
};

/// @param places of probePlan()
Prediction predict(const Plan& plan, const std::vector<std::vector<DirectionProbe>>& places,
                   const std::string& point, const std::string& method);

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// The method chosen at a choice point, and the error expected in an image of the material.
/// Times are those that the table gives, per evaluation of the material's lobes.
struct PlannedMethod {
    std::string point, method;
    bool forced = false;
    bool measured = false;     ///< false: the table says nothing of it, and error counts as 0
    double error = 0.0;        ///< relative luminance
    double errorDefault = 0.0; ///< of the point's default method
    double ns = 0.0, nsDefault = 0.0, nsTruth = 0.0;
};

struct DirectionProbe;

struct MethodPlan {
    double tolerance = -1.0;      ///< as asked for
    double error = 0.0;           ///< of all points; more than methodShare allows only where forced
    double albedo = 0.0;          ///< largest directional albedo that was seen, luminance
    bool varies = false;          ///< parameters vary; the worst that was seen counts
    bool fallback = false;        ///< the material has no usable surface: displayColor was planned
    double microfacetShare = 0.0; ///< largest share of the light of mirrors, smooth or rough
    double smoothest = 1.0;       ///< roughness (root of alpha) of the smoothest of them
    /// Place by place and angle by angle, as it was planned by (planProbes.h); null: not at all.
    std::shared_ptr<const std::vector<std::vector<DirectionProbe>>> probes;
    std::vector<PlannedMethod> choices; ///< of choicesThatMatter() that have a truth, or noise
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/plan/plan.h"

#include <string>
#include <vector>

namespace patina {

/// How far the method positionFree of the choice point layering applies to a layer.
struct LayerWalkability {
    bool walks = false;
    std::string reason; ///< why not
};

/// Whether a layer belongs to a model that says itself how much the interface on top darkens what
/// is below. Light that the interface sends back down is then no part of the layer.
bool darkensItself(const Plan& plan, const PlanClosure& closure);

/// For every closure of a plan, whether it is a layer whose light can be walked between its top and
/// its base: the top is one interface that reflects, and light does not pass the base straight, or
/// go beneath it, or through a lobe that is the other half of the same interface; and no model
/// darkens the base already.
std::vector<LayerWalkability> layerWalkability(const Plan& plan, method::Subsurface subsurface);

} // namespace patina

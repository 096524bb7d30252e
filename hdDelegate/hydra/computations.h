// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/hydra/sampling.h"

#include <pxr/imaging/hd/extComputationUtils.h>
#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

using ComputedValues = HdExtComputationUtils::SampledValueStore<maxTimeSamples>;

/// Runs the computations of primvars, such as skinning, over the shutter. One sample where no input
/// varies. @returns values by the name of the primvar; those of a computation that failed are empty
ComputedValues computedValues(const HdExtComputationPrimvarDescriptorVector& primvars,
                              HdSceneDelegate& delegate, const HdPatinaRenderParam& param);

} // namespace patina

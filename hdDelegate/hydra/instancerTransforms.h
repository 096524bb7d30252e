// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// The transforms of an instancer's instances in the space of its parent, by index, with their
/// motion: instancer * translate * rotate * scale * transform (column vectors), as HdInstancer
/// defines it. Arrays of different lengths count as long as the longest; what is missing is the
/// identity.
std::vector<MotionTransform> readInstanceTransforms(HdSceneDelegate& delegate, const SdfPath& id,
                                                    HdPatinaRenderParam& param);

/// The matrices of one of the primvars that make up these transforms (HdInstancerTokens).
/// @returns nothing of another primvar and of another type
std::vector<GfMatrix4d> instanceMatrices(const TfToken& primvar, const VtValue& value);

} // namespace patina

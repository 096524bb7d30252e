// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/geometry.h"
#include "hdDelegate/scene/primMarks.h"

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// A number or a text; of an array its only element. @returns false for other values
bool markOf(const VtValue& value, MarkValue& mark);

/// Gives a prim what its constant primvars of primMarks.def say, and takes away what they no longer
/// do.
void readMarks(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
               Geometry& prim);

/// What marks native instances, of which Hydra makes values of its instancer's instances.
/// @returns one of each of `count` instances; empty where there are no marks
std::vector<Marked> marksOfInstances(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                     const SdfPath& id, size_t count);

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/geometry.h"

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// Gives a prim what its constant primvars of primMarks.def say, and takes away what they no longer
/// do.
void readMarks(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
               Geometry& prim);

} // namespace patina

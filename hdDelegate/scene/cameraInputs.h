// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/camera.h"
#include "hdDelegate/scene/primMarks.h"

namespace patina {

/// Names of cameraInputs.def, in the order of their strength. Each may stand after "primvars:" too.
std::vector<std::string> cameraInputNames();

/// Gives a camera the lens that its attributes say. A value that no attribute gives stays. Values
/// that a camera does not take are told by camera and attribute, and count as not there.
/// @param inputs values by names of cameraInputs.def; others are ignored
void applyCameraInputs(const Marks& inputs, Camera& camera, Diagnostics& diagnostics);

} // namespace patina

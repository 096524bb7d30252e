// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/camera.h"
#include "base/diagnostics.h"

#include <memory>

namespace patina {

/// A camera whose numbers rays can be made of: what is not finite, and lenses and distances that
/// are too large for 32 bits, are replaced with a warning that names camera and input. Transforms
/// stay as they are, see hasInverse().
/// @returns the camera itself where nothing is wrong with it
std::shared_ptr<const Camera> checkedCamera(std::shared_ptr<const Camera> camera,
                                            Diagnostics& diagnostics);

} // namespace patina

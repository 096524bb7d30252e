// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/aov.h>

#include <string>

namespace patina {

/// The film's name of an AOV as Hydra names it; empty when there is none. Hydra's `depth` is window
/// depth (the film's deviceDepth), its `cameraDepth` the distance along the camera's axis (the
/// film's depth); the other names are the same, primvars:NAME and lpe:EXPR among them.
std::string filmAovOf(const TfToken& hydraName);

/// The same of an AOV that a buffer is bound to: empty, with a warning, for one that no buffer
/// holds.
std::string bufferAovOf(const TfToken& hydraName);

/// The buffer that a host should allocate for an AOV; of format HdFormatInvalid when it is not
/// known.
HdAovDescriptor aovDescriptor(const TfToken& hydraName);

} // namespace patina

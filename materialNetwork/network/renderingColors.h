// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/color/renderingSpace.h"
#include "materialNetwork/network/network.h"

namespace patina {

/// A network whose colours are those of a rendering space: authored colours, defaults that are not
/// grey, and what ND_blackbody gives. Textures and primvars are converted where they are read.
/// Indices of refraction per channel and luma coefficients are no colours, although their type is.
/// A colour of an unknown space stays as it is, so that coerceValue() tells of it.
Network inRenderingSpace(const Network& network, const RenderingSpace& space);

} // namespace patina

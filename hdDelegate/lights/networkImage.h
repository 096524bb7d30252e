// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/imageTextureLoad.h"
#include "hdDelegate/scene/light.h"

namespace patina {

/// The image that a light's network paints, as its texture would lie: latlong around a dome, or on
/// a rect. Nodes find texture coordinates of that image (v up), and as position and normal of every
/// space the direction into the dome, or the place on the rect, in the light's frame.
/// @param texture of the light, which it multiplies texel by texel; null: none
ImageRGB networkImage(const Light& light, const ImageRGB* texture, const RenderingSpace& space,
                      Diagnostics& diagnostics);

} // namespace patina

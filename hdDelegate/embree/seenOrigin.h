// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"

namespace patina {

/// The best origin of rays for the things that a camera sees. Numbers of 32 bits are exact only
/// near the origin. The answer is 0, the world's own origin, unless the things in view are more
/// than 60 times as far from it as the view is wide there. (Rays start off their surface by 4e-6 of
/// their distance to the origin. At 60 widths that is a quarter of a pixel of an image 1000 pixels
/// wide.)
/// @param scene as built for this camera, from any origin. The answer does not depend on that
///        origin, unless it is too far away to tell the things in view apart
dvec3 originOfSeen(const EmbreeScene& scene, const Camera& camera, const RenderSettings& settings);

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"

namespace patina {

/// Where the origin of rays should be for what a camera sees: numbers of 32 bits tell apart what is
/// near by it only. That is the world's own, 0, unless this lies more than 60 times as far from
/// what is seen as the view is wide there: starts of rays are off their surface by 4e-6 of their
/// distance to the origin, which then are a quarter of the pixel of an image 1000 wide.
/// @param scene as built for this camera, from any origin; the answer does not depend on it, but
/// for what the origin of now is too far away to tell apart
dvec3 originOfSeen(const EmbreeScene& scene, const Camera& camera, const RenderSettings& settings);

} // namespace patina

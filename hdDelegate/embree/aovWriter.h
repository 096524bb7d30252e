// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/surface.h"
#include "hdDelegate/film/film.h"

namespace patina {

/// Where one camera sample writes.
struct AovTarget {
    Film& film;
    int x, y;
    float distance;  ///< from the pixel's centre
    int quarter = 0; ///< of the pixel: see PixelSplat
};

/// Writes every AOV but colour and alpha for the first surface that a camera ray meets.
void writeAovs(const std::vector<AovSpec>& aovs, const AovTarget& target, const CameraRays& camera,
               const SurfacePoint& point, const Bsdf& bsdf);

/// Writes depths, place and prim where splats have taken half of the light. They have no surface to
/// show more of.
void writeScreenAovs(const std::vector<AovSpec>& aovs, const AovTarget& target,
                     const CameraRays& camera, const vec3& position, const vec3& origin,
                     int primId);

} // namespace patina

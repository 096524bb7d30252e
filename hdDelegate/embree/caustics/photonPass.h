// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/caustics/photonMap.h"
#include "hdDelegate/embree/path.h"

namespace patina {

/// Caustics that paths find while a block of samples is taken: light that comes to surfaces that
/// are no glass by way of glass (Jensen 1996). docs/design/pathTracer.md has the partition between
/// photons and paths.
struct PhotonPass {
    /// Widths of a pixel's cone at the surface, in the first block.
    static constexpr float firstRadius = 2.0f;

    PhotonMap map;
    float radius = firstRadius; ///< in which photons count, likewise

    /// Shows photons where a path meets a surface that is no glass, and notes which light they have
    /// from there. @param width of the ray's cone
    void meet(Path& path, const SurfacePoint& point, const Bsdf& bsdf, float width,
              const CameraRays& camera, int maxDepth) const;

private:
    vec3 light(const Path& path, const SurfacePoint& point, const Bsdf& bsdf, float width,
               const CameraRays& camera, int maxDepth) const;
};

} // namespace patina

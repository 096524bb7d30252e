// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/caustics/photonPass.h"

#include "hdDelegate/embree/caustics/causticCasters.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

vec3 PhotonPass::light(const Path& path, const SurfacePoint& point, const Bsdf& bsdf, float width,
                       const CameraRays& camera, int maxDepth) const {
    constexpr float flat = 0.9f;  // cosine between surfaces that share photons
    constexpr float thick = 0.3f; // of the radius, off the surface's plane
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
    const vec3 n = back ? -s.geometricNormal : s.geometricNormal;
    // Seen through rough glass the cone is wide, and the photons of it many. A pixel is enough.
    const vec3 eye = vec3(camera.worldToCamera() * vec4(s.position, 1.0f));
    const float pixel = camera.pixelSpread() * (camera.orthographic() ? 1.0f : glm::length(eye));
    const float reach = std::max(radius * std::min(width, pixel), point.offset);
    vec3 sum(0.0f);
    map.visit(s.position, reach, [&](const Photon& photon) {
        // Of one side of the surface, unless it lets light through.
        const float facing = glm::dot(photon.normal, n);
        if (bsdf.transmits() ? std::abs(facing) < flat : facing < flat) return;
        if (std::abs(glm::dot(photon.position - s.position, n)) > thick * reach) return;
        if (photon.bounces + path.depth >= maxDepth) return;
        const BsdfEval f = bsdf.eval(photon.towards);
        const float c = std::abs(glm::dot(photon.towards, s.geometricNormal));
        if (c > 0.0f) sum += (f.diffuse + f.specular) * photon.flux / std::max(c, 1e-3f);
    });
    return sum / (pi * reach * reach);
}

void PhotonPass::meet(Path& path, const SurfacePoint& point, const Bsdf& bsdf, float width,
                      const CameraRays& camera, int maxDepth) const {
    if (castsCaustics(*point.slot->program)) {
        path.throughCasters = path.onPhotons;
        return;
    }
    path.onPhotons = path.throughCasters = false;
    if (!bsdf.hasNonDelta() || !path.media.empty()) return;
    path.onPhotons = true;
    path.add(light(path, point, bsdf, width, camera, maxDepth));
}

} // namespace patina

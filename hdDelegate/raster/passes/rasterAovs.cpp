// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterAovs.h"

#include "hdDelegate/film/aovValues.h"
#include "hdDelegate/parallel.h"

#include <algorithm>

namespace patina {

namespace {

/// For aovValue(): one pixel of the images.
struct PixelPoint {
    static constexpr bool denoisingOfPaths = false;

    const RasterAovImages& images;
    const RasterCamera& camera;
    const vec3& origin; ///< of positions
    int slot;           ///< of the primvar that is asked for, -1 where it was not drawn
    size_t i;

    vec3 inCamera() const {
        return vec3(camera.worldToCamera() * vec4(vec3(images.positions[i]), 1.0f));
    }
    float depth() const { return -inCamera().z; }
    float windowDepth() const { return camera.windowDepth(inCamera()); }
    vec3 position() const { return origin + vec3(images.positions[i]); }
    vec3 normal() const { return vec3(images.normals[i]); }
    const mat4& worldToCamera() const { return camera.worldToCamera(); }
    int primId() const { return images.ids[4 * i]; }
    int instanceId() const { return images.ids[4 * i + 1]; }
    int elementId() const { return images.ids[4 * i + 2]; }
    bool albedo(float out[4]) const {
        return !images.albedos.empty() && put(images.albedos[i], out);
    }
    bool primvar(float out[4]) const {
        return slot >= 0 && put(images.primvars[size_t(slot)][i], out);
    }

private:
    static bool put(const vec4& v, float out[4]) {
        out[0] = v.x, out[1] = v.y, out[2] = v.z, out[3] = v.w;
        return true;
    }
};

} // namespace

void RasterAovs::write(const RasterAovImages& images, const RasterAovRequest& request,
                       Film& film) const {
    for (size_t a = 0; a < aovs.size(); ++a) {
        const AovSpec& spec = aovs[a];
        if (spec.id == AovId::unknown) continue;
        const int slot = RasterAovRequest::slot(request.primvars, spec.primvar);
        parallelFor(window[1], std::max(window[1], window[3] + 1), [&](int y) {
            for (int x = window[0]; x <= window[2]; ++x) {
                const size_t i = size_t(height - 1 - y) * size_t(width) + size_t(x);
                if (images.positions[i].w == 0.0f) continue;
                float out[4] = {0, 0, 0, 0};
                if (aovValue(spec.id, PixelPoint{images, camera, origin, slot, i}, out))
                    film.addAov(int(a), x, y, out, 0.0f);
            }
        });
    }
}

} // namespace patina

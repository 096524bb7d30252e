#include "hdDelegate/raster/passes/rasterAovs.h"

#include "hdDelegate/film/denoiser.h"

#include <algorithm>
#include <functional>

namespace patina {

void RasterAovs::write(const RasterAovImages& images, const RasterAovRequest& request,
                       Film& film) const {
    const auto& [positions, normals, albedos, primvars, ids] = images;
    const mat4& toCamera = camera.worldToCamera();
    for (size_t a = 0; a < aovs.size(); ++a) {
        const std::string& name = aovs[a].name;
        const auto each4 = [&](const std::function<vec4(size_t)>& value) {
            for (int y = window[1]; y <= window[3]; ++y)
                for (int x = window[0]; x <= window[2]; ++x) {
                    const size_t i = size_t(height - 1 - y) * size_t(width) + size_t(x);
                    if (positions[i].w == 0.0f) continue;
                    const vec4 v = value(i);
                    const float out[4] = {v.x, v.y, v.z, v.w};
                    film.addAov(int(a), x, y, out, 0.0f);
                }
        };
        const auto each = [&](const std::function<vec3(size_t)>& value) {
            each4([&](size_t i) { return vec4(value(i), 0.0f); });
        };
        const auto inCamera = [&](size_t i) {
            return vec3(toCamera * vec4(vec3(positions[i]), 1.0f));
        };
        const auto id = [&](int k) {
            each4([&, k](size_t i) { return vec4(glm::intBitsToFloat(ids[4 * i + size_t(k)])); });
        };
        if (name == "depth")
            each([&](size_t i) { return vec3(-inCamera(i).z); });
        else if (name == "cameraDepth")
            each([&](size_t i) { return vec3(glm::length(inCamera(i))); });
        else if (name == "deviceDepth")
            each([&](size_t i) { return vec3(camera.windowDepth(inCamera(i))); });
        else if (name == "normal" || name == denoisingNormalAov)
            each([&](size_t i) { return vec3(normals[i]); });
        else if (name == "Neye")
            each([&](size_t i) {
                const vec3 n = mat3(toCamera) * vec3(normals[i]);
                return n / std::max(1e-30f, glm::length(n));
            });
        else if (name == "position")
            each([&](size_t i) { return origin + vec3(positions[i]); });
        else if ((name == "albedo" || name == denoisingAlbedoAov) && !albedos.empty())
            each([&](size_t i) { return vec3(albedos[i]); });
        else if (name.rfind("primvars:", 0) == 0) {
            const int slot = RasterAovRequest::slot(request.primvars, name.substr(9));
            if (slot >= 0) each4([&](size_t i) { return primvars[size_t(slot)][i]; });
        } else if (name == "primId")
            id(0);
        else if (name == "instanceId")
            id(1);
        else if (name == "elementId")
            id(2);
    }
}

} // namespace patina

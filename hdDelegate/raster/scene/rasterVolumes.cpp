// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterVolumes.h"

#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int maxTexels = 64;           ///< along a side
constexpr float largestHalf = 60000.0f; ///< that the textures hold

GlTexture upload(const ivec3& size, const std::vector<vec4>& texels) {
    GlTexture texture(GL_TEXTURE_3D, GL_RGBA16F, size.x, size.y, size.z);
    gl.TextureSubImage3D(texture.id(), 0, 0, 0, 0, size.x, size.y, size.z, GL_RGBA, GL_FLOAT,
                         texels.data());
    texture.filter(GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        texture.parameter(axis, GL_CLAMP_TO_EDGE);
    return texture;
}

vec3 held(const vec3& v) {
    return glm::clamp(v, vec3(0.0f), vec3(largestHalf));
}

} // namespace

void RasterVolume::bind() const {
    textures->scattering.bind(0);
    textures->extinction.bind(1);
    textures->emission.bind(2);
}

void RasterVolumes::build(Cached& cached) {
    cached.volumes.clear();
    const VolumeMedium& medium = *cached.medium;
    if (medium.empty()) return;
    const vec3 low = medium.boundsMin(), extent = medium.boundsMax() - low;
    const float longest = std::max({extent.x, extent.y, extent.z});
    ivec3 size;
    for (int a = 0; a < 3; ++a)
        size[a] = std::clamp(int(std::ceil(float(maxTexels) * extent[a] / longest)), 2, maxTexels);
    const size_t count = size_t(size.x) * size_t(size.y) * size_t(size.z);
    std::vector<vec4> scattering(count), extinction(count), emission(count);
    parallelFor(size_t(0), size_t(size.z), [&](size_t z) {
        size_t i = z * size_t(size.x) * size_t(size.y);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x, ++i) {
                const vec3 at = (vec3(float(x), float(y), float(z)) + 0.5f) / vec3(size);
                const Medium m = medium.at(low + extent * at);
                float g = 0.0f, sum = 0.0f;
                for (int p = 0; p < m.phaseCount; ++p) {
                    const vec3& s = m.phases[p].scattering;
                    g += (s.x + s.y + s.z) * m.phases[p].anisotropy;
                    sum += s.x + s.y + s.z;
                }
                scattering[i] = vec4(held(m.scattering()),
                                     sum > 0.0f ? std::clamp(g / sum, -0.98f, 0.98f) : 0.0f);
                extinction[i] = vec4(held(m.extinction()), 0.0f);
                emission[i] = vec4(held(m.emission), 0.0f);
            }
    });
    auto textures = std::make_shared<RasterVolume::Textures>();
    textures->scattering = upload(size, scattering);
    textures->extinction = upload(size, extinction);
    textures->emission = upload(size, emission);
    for (const mat4& toWorld : cached.places) {
        const mat4 inverse = glm::inverse(toWorld);
        if (!std::isfinite(inverse[0][0] + inverse[1][1] + inverse[2][2] + inverse[3][3])) {
            _diagnostics.warn(cached.prim->path, "transform", messages::volumeWithoutInverse);
            continue;
        }
        RasterVolume volume;
        volume.boundsMin = low;
        volume.boundsMax = medium.boundsMax();
        volume.worldToObject = inverse;
        volume.textures = textures;
        cached.volumes.push_back(std::move(volume));
    }
}

void RasterVolumes::add(const std::shared_ptr<const Volume>& prim, const SceneState& state,
                        const RenderSettings& settings, const std::vector<mat4>& toWorld,
                        vec3& minimum, vec3& maximum) {
    Cached& cached = _cache[prim->path];
    const auto found = state.materials.find(prim->material);
    const auto material =
        found != state.materials.end() && settings.enableSceneMaterials ? found->second : nullptr;
    if (cached.prim != prim || cached.material != material || cached.methods != settings.methods ||
        cached.places != toWorld) {
        cached.medium = _compiled.medium(prim, state, settings);
        cached.prim = prim;
        cached.material = material;
        cached.methods = settings.methods;
        cached.places = toWorld;
        build(cached);
    }
    cached.used = true;
    for (const RasterVolume& volume : cached.volumes) {
        if (_placed.size() >= maxPlaced) {
            _diagnostics.warn(prim->path, "", messages::volumesTooMany(maxPlaced));
            break;
        }
        _placed.push_back(&volume);
        const mat4 out = glm::inverse(volume.worldToObject);
        for (int i = 0; i < 8; ++i) {
            const vec3 corner(i & 1 ? volume.boundsMax.x : volume.boundsMin.x,
                              i & 2 ? volume.boundsMax.y : volume.boundsMin.y,
                              i & 4 ? volume.boundsMax.z : volume.boundsMin.z);
            const vec3 p = vec3(out * vec4(corner, 1.0f));
            minimum = glm::min(minimum, p);
            maximum = glm::max(maximum, p);
        }
    }
}

void RasterVolumes::release() {
    for (auto& item : _cache)
        item.second.medium = nullptr;
}

void RasterVolumes::end() {
    for (auto it = _cache.begin(); it != _cache.end();)
        if (it->second.used) {
            it->second.used = false;
            ++it;
        } else {
            it = _cache.erase(it);
        }
}

} // namespace patina

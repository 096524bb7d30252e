// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/glowingSurfaces.h"

namespace patina {

/// Properties of a light, beyond its shape, that the integrator reads.
struct LightInfo {
    std::shared_ptr<const Light> prim; ///< null for surfaces whose material glows
    bool cameraVisible = true;
    bool dome = false;
    bool triangles = false; ///< the true radiance is that of a surface
    int lightCategory, shadowCategory;
    float diffuse = 1.0f, specular = 1.0f;
    bool castsShadows = true;
    /// What hides it from a point is not what a ray meets: no shadows, coloured ones, others.
    bool ownShadows = false;
    vec3 shadowColor{0.0f};
    float shadowDistance = -1.0f, shadowFalloff = -1.0f, shadowFalloffGamma = 1.0f;
};

/// The lights of a scene and everything that glows, for one shutter. Immutable once built.
class SceneLights {
public:
    /// Category of a light that lights (or is shadowed by) everything.
    static constexpr int everything = -2;

    SceneLights(const SceneState& state, const EmbreeScene& scene, const Camera& camera,
                const RenderSettings& settings, LightImages& images, Diagnostics& diagnostics);

    const LightSet& set() const { return *_set; }
    const LightInfo& info(int light) const {
        return _infos[light < _set->lightCount() ? light : _glowing.infoOf(placeOf(light))];
    }
    /// Requests the memory of what info() gives.
    void request(int light) const {
        if (light >= 0 && light < _set->lightCount()) __builtin_prefetch(&_infos[size_t(light)]);
    }
    /// Some light treats diffuse and other lobes differently.
    bool splitsLobes() const { return _splitsLobes; }
    /// Some light is linked to a part of the surfaces.
    bool linksSurfaces() const { return _linksSurfaces; }
    /// Some light has LightInfo::ownShadows.
    bool hasOwnShadows() const { return _hasOwnShadows; }

    /// Light index of a triangle that was hit; -1 when it does not emit.
    int triangleLight(const Hit& hit) const;
    /// The surface of a light that is a triangle; null for others.
    const Surface* triangleSurface(int light) const {
        return light < _set->lightCount() ? nullptr : _glowing.surface(placeOf(light));
    }
    /// Radiance of a sample towards a point, but for image().
    vec3 radiance(const LightSample& sample, const vec3& from, float time) const {
        return info(sample.light).triangles ? triangleRadiance(sample, from, time)
                                            : sample.radiance;
    }
    /// The colour of an image there; reading it takes time.
    vec3 image(const LightSample& sample) const {
        return info(sample.light).triangles ? vec3(1.0f) : _set->image(sample);
    }
    /// The radiance of a surface towards its viewer, by its material and as a mesh light.
    /// @param lit the point that it lights, which filters of mesh lights ask for; null: unfiltered
    /// @param place of the surface, from its first one; -1: that of the hit
    vec3 emission(const SurfacePoint& point, const vec3* lit = nullptr, int place = -1) const;
    /// A mesh light that is nothing but a light (materialSyncMode noMaterialResponse).
    bool hidesMaterial(const Surface* surface) const {
        if (!_hidesMaterials) return false;
        const auto found = _meshLights.find(surface);
        return found != _meshLights.end() && found->second.glow == MeshLight::Glow::Hidden;
    }

private:
    struct MeshLight {
        enum class Glow { TintsLight, AddsToLight, Hidden }; ///< of the surface's material
        static Glow glowOf(const Light& light);

        std::shared_ptr<const Light> light;
        vec3 radiance{0.0f};
        int info = 0;
        Glow glow = Glow::TintsLight;
        std::vector<LightFilters> filters; ///< per place of the surface; none: nothing is filtered
        std::vector<float> areas; ///< that divide the radiance at each place; none: it is divided
    };

    vec3 triangleRadiance(const LightSample& sample, const vec3& from, float time) const;
    /// Whether so many more lights are within Limit::lights.
    static bool haveRoom(double more, const LightSetInput& input);
    static void warnOfMany(const std::string& light, Diagnostics& diagnostics);
    LightInfo describe(const std::shared_ptr<const Light>& light, const EmbreeScene& scene,
                       const RenderSettings& settings);
    void addSurface(const Surface& surface, const EmbreeScene& scene, LightSetInput& input,
                    Diagnostics& diagnostics);
    int placeOf(int light) const { return _set->placeOf(light - _set->lightCount()); }

    std::unique_ptr<LightSet> _set;
    std::vector<LightInfo> _infos;
    GlowingSurfaces _glowing;
    std::map<const Surface*, MeshLight> _meshLights;
    int _glowInfo = 0;
    bool _splitsLobes = false, _linksSurfaces = false, _hasOwnShadows = false,
         _hidesMaterials = false;
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/rasterLights.h"

#include "hdDelegate/lights/resolvedLight.h"
#include "hdDelegate/scene/lightUnits.h"
#include "materialNetwork/diagnostics.h"
#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// @returns -1 for an empty link, which is everything
int categoryOf(const std::string& link, const LinkNames& links) {
    return link.empty() ? -1 : links.of(link);
}

} // namespace

RasterLights::RasterLights(const SceneState& state, const RenderSettings& settings,
                           RasterInstances& places, float timeCode, int domeSamples,
                           const std::set<std::string>& domeMethods, LightImages& images,
                           RasterDomes& domes, const LinkNames& links, Diagnostics& diagnostics)
    : _domeMethods(domeMethods), _domeSamples(domeSamples), _seed(uint32_t(settings.seed)),
      _shadows(settings.enableShadows), _takeAway(takesLightAway(state, settings)) {
    if (!domeMethods.empty() && domeMethods.count("sampled") == 0) _domeSamples = 0;
    domes.begin();
    if (settings.enableSceneLights)
        for (const auto& item : state.lights) {
            const Light& light = *item.second;
            if (!light.visible) continue;
            if (!light.filters.empty())
                diagnostics.warn(light.path, "light:filters",
                                 "light filters are not applied by the rasterizer");
            if (light.type == LightType::Mesh) continue; // see RasterEmitters
            for (const RasterPlace& place : places.places(light.group))
                add(light, mat4(place.groupToWorld * exactTransformAt(light.transform, timeCode)),
                    settings, images, domes, links, diagnostics);
        }
    _tables.upload(maxTables);
    domes.upload(_domeMethods.count("prefiltered") > 0);
}

void RasterLights::add(const Light& light, const mat4& toWorld, const RenderSettings& settings,
                       LightImages& images, RasterDomes& domes, const LinkNames& links,
                       Diagnostics& diagnostics) {
    const ResolvedLight is = resolveLight(light, toWorld, diagnostics);
    if (is.kind == ResolvedLight::Kind::None) return;
    const LightPose pose = lightPose(light, is.kind, toWorld, nullptr);
    Source s;
    s.radiance = is.radiance;
    s.delta = is.delta;
    s.position = pose.position;
    s.shadows = light.shadowEnable;
    s.shadowCategory = categoryOf(light.shadowLink, links);
    GpuLight& g = s.fixed;
    g.shadowColor = vec4(light.shadowColor, 0.0f);
    g.fade = vec4(light.shadowDistance, light.shadowFalloff,
                  std::max(light.shadowFalloffGamma, 1e-3f), 1.0f);
    const shLights::Shaping& beam = pose.shaping.beam();
    g.shaping = vec4(beam.axis, beam.focus);
    g.focusTint = vec4(beam.focusTint, beam.cone ? 1.0f : 0.0f);
    g.cone = vec4(beam.coneStart, beam.coneEnd, 0.0f, 0.0f);
    const ProfileTable profile = _tables.profile(light, diagnostics);
    g.table.w = float(profile.first);
    g.shapingX = vec4(beam.x, float(profile.thetas));
    g.shapingY = vec4(beam.y, float(profile.phis));
    bool cameraVisible = light.cameraVisible;
    switch (is.kind) {
    case ResolvedLight::Kind::Distant:
        s.kind = Distant;
        s.toLight = pose.toLight;
        g.cone = vec4(0.0f, 0.0f, is.versine, 2.0f * pi * is.versine);
        _hasWideSun |= is.versine > narrowSun;
        g.origin = vec4(s.toLight, 0.0f);
        s.weight = luminance(glm::abs(s.radiance)) * (s.delta ? 1.0f : std::min(g.cone.w, pi));
        break;
    case ResolvedLight::Kind::Dome:
        s.domeToWorld = pose.domeToWorld;
        addDome(s, light, images, domes);
        cameraVisible &= settings.domeLightCameraVisibility;
        _hasDome = true;
        break;
    case ResolvedLight::Kind::Point:
        s.kind = Point;
        s.weight = luminance(glm::abs(s.radiance));
        break;
    case ResolvedLight::Kind::Line: {
        const float length = glm::length(pose.along);
        s.kind = Line;
        s.toLight = pose.along;
        g.axis[0] = vec4(pose.along / length, 0.0f);
        s.extent = 0.5f * length;
        s.weight = luminance(glm::abs(s.radiance)) * length;
        break;
    }
    default: s.shape = pose.shape; addShape(s, light, images);
    }
    g.axis[2].w = float(categoryOf(light.lightLink, links));
    g.inverse[0].w = light.diffuse;
    g.inverse[1].w = light.specular;
    g.inverse[2].w = cameraVisible && !s.delta ? 1.0f : 0.0f;
    if (s.delta) g.origin.w = 1.0f;
    _sources.push_back(s);
    if (light.type == LightType::Dome && s.sunIrradiance != vec3(0.0f)) {
        Source sun = s;
        sun.kind = Distant;
        sun.delta = true;
        sun.toLight = s.domeToWorld * s.sunDirection;
        sun.radiance = s.radiance * s.sunIrradiance;
        sun.weight = luminance(glm::abs(sun.radiance));
        sun.environment = nullptr;
        sun.fixed.origin = vec4(sun.toLight, 1.0f);
        sun.fixed.cone = vec4(1.0f, 0.0f, 0.0f, 0.0f);
        sun.fixed.inverse[2].w = 0.0f;
        _sources.push_back(sun);
    }
}

/// The image, and where the harmonics light surfaces also those and the dominant light.
void RasterLights::addDome(Source& s, const Light& light, LightImages& images, RasterDomes& domes) {
    s.kind = Dome;
    GpuLight& g = s.fixed;
    int layer = -1, first = -1;
    if (!light.textureFile.empty()) {
        s.environment = images.environment(light.textureFile, light.textureColorSpace,
                                           environmentFormat(light.textureFormat), light.path,
                                           "inputs:texture:file");
        layer = domes.layer(s.environment);
        const bool bare = _domeMethods.count("harmonicsUnwindowed") > 0;
        if (bare || _domeMethods.count("harmonics") > 0 || _domeMethods.count("prefiltered") > 0) {
            const SkyHarmonics& sky = domes.harmonics(s.environment, bare);
            std::vector<vec4> values;
            for (const vec3& c : sky.irradiance)
                values.emplace_back(c, 0.0f);
            first = _tables.add(values);
            s.sunDirection = sky.sunDirection;
            s.sunIrradiance = sky.sunIrradiance;
        }
    }
    for (int i = 0; i < 3; ++i)
        g.axis[i] = vec4(s.domeToWorld[i], 0.0f);
    g.cone = vec4(float(layer), float(_domeSamples), float(first), 0.0f);
    g.origin = vec4(s.radiance, 0.0f);
}

/// The parameters of a shape, and a rect's image.
void RasterLights::addShape(Source& s, const Light& light, LightImages& images) {
    s.kind = Kind(int(s.shape.kind));
    GpuLight& g = s.fixed;
    if (const RectImage* image = _tables.rect(light, images)) {
        s.image = image;
        g.table = vec4(float(image->first), float(image->width), float(image->height), g.table.w);
    }
    vec3 low(INFINITY), high(-INFINITY);
    growBounds(s.shape, low, high);
    s.extent = 0.5f * glm::length(high - low);
    s.weight = luminance(glm::abs(s.radiance)) * 0.25f * s.extent * s.extent * pi;
    for (int i = 0; i < 3; ++i) {
        g.axis[i] = vec4(s.shape.axes[i], 0.0f);
        g.inverse[i] = vec4(s.shape.inverse[i], 0.0f);
    }
    g.origin = vec4(s.shape.origin, 0.0f);
    s.position = s.shape.origin;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/rasterLights.h"

#include "hdDelegate/lights/resolvedLight.h"
#include "hdDelegate/raster/scene/rasterEmitters.h"
#include "hdDelegate/scene/lightUnits.h"
#include "base/diagnostics.h"
#include "base/limits.h"
#include "base/maths.h"
#include "shaders/lights.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// @returns -1 for an empty link, which is everything
int categoryOf(const std::string& link, const LinkNames& links) {
    return link.empty() ? -1 : links.of(link);
}

} // namespace

GpuLight RasterLightSource::sample(const vec3& u) const {
    GpuLight g = fixed;
    g.kind = kind;
    g.radiance = radiance;
    switch (kind) {
    default: { // shapes
        if (shape.kind == AreaShape::Kind::Sphere) {
            g.samplePlace(shape.origin + shape.axes * shLights::sphereLightPlace(u));
            break;
        }
        vec3 q = shLights::shapePlace(kind, vec2(u));
        float dense = 1.0f;
        if (image) { // shaders look the image up
            vec2 on;
            dense = image->sample(vec2(u), on);
            q = vec3(on, 0.0f);
        }
        g.samplePlace(shape.origin + shape.axes * q);
        g.normal = shapeNormalAt(kind, shape, q);
        g.density = dense * shapePlaceDensity(kind, shape, q);
        break;
    }
    case Point: g.samplePlace(position); break;
    case Line: g.samplePlace(position + (u.x - 0.5f) * toLight); break;
    case Distant: {
        const vec3 helper = std::fabs(toLight.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0);
        const vec3 x = glm::normalize(glm::cross(helper, toLight));
        const vec3 direction =
            shLights::distantSample({x, glm::cross(toLight, x), toLight}, g.versine, vec2(u));
        g.sampleDirection(direction, delta ? 1.0f : 1.0f / (2.0f * pi * g.versine));
        break;
    }
    case Dome: {
        vec3 d;
        float pdf = 0.25f / pi;
        if (environment) {
            d = environment->sample(vec2(u), pdf);
            g.radiance *= environment->radiance(d);
        } else {
            d = shLights::spherePlace(vec2(u));
        }
        g.sampleDirection(domeToWorld * d, pdf);
        if (!(pdf > 0.0f)) g.radiance = vec3(0.0f), g.density = 1.0f;
    }
    }
    return g;
}

RasterLights::RasterLights(const SceneState& state, const RenderSettings& settings,
                           RasterInstances& places, float timeCode, int domeSamples,
                           const std::set<std::string>& domeMethods, LightImages& images,
                           RasterDomes& domes, const LinkNames& links, Diagnostics& diagnostics,
                           bool pixelsChoose)
    : _domeMethods(domeMethods), _domeSamples(domeSamples), _seed(uint32_t(settings.seed)),
      _shadows(settings.enableShadows), _takeAway(takesLightAway(state, settings)),
      _pixelsChoose(pixelsChoose) {
    if (!domeMethods.empty() && domeMethods.count("sampled") == 0) _domeSamples = 0;
    domes.begin();
    if (settings.enableSceneLights)
        for (const auto& item : state.lights) {
            const Light& light = *item.second;
            if (!light.visible) continue;
            if (light.type == LightType::Mesh) { // see RasterEmitters
                _filters.addMesh(light, places.places(light.group), timeCode, images, _tables,
                                 diagnostics);
                continue;
            }
            warnOfDomeMethods(light, diagnostics);
            if (double(_sources.size() + places.places(light.group).size()) >
                double(limitOf(Limit::lights))) {
                diagnostics.warn(light.path, "", messages::lightsTooMany(limitText(Limit::lights)));
                continue;
            }
            for (const RasterPlace& place : places.places(light.group))
                add(light, mat4(place.groupToWorld * exactTransformAt(light.transform, timeCode)),
                    _filters.add(light, place, timeCode, images, _tables, diagnostics), settings,
                    images, domes, links, diagnostics);
        }
    _tables.upload(RasterEmitters::maxSamples * RasterEmission::maxValues);
    domes.upload(_domeMethods.count("prefiltered") > 0);
}

/// Harmonics and prefiltered maps are of a sky that is the same at every point.
void RasterLights::warnOfDomeMethods(const Light& light, Diagnostics& diagnostics) const {
    if (light.type != LightType::Dome || light.filters.empty()) return;
    for (const char* method : {"prefiltered", "harmonics"})
        if (_domeMethods.count(method) > 0)
            diagnostics.warn(light.path, "light:filters", messages::domeMethodUnfiltered(method));
}

void RasterLights::add(const Light& light, const mat4& toWorld, int filters,
                       const RenderSettings& settings, LightImages& images, RasterDomes& domes,
                       const LinkNames& links, Diagnostics& diagnostics) {
    const ResolvedLight is = resolveLight(light, toWorld, diagnostics);
    if (is.kind == ResolvedLight::Kind::None) return;
    const LightPose pose = lightPose(light, is.kind, toWorld, nullptr);
    RasterLightSource s;
    s.radiance = is.radiance;
    s.delta = is.delta;
    s.position = pose.position;
    s.shadows = _shadows && light.shadowEnable;
    s.shadowCategory = categoryOf(light.shadowLink, links);
    GpuLight& g = s.fixed;
    g.shadowColor = light.shadowColor;
    g.shadowDistance = light.shadowDistance;
    g.shadowFalloff = std::min(light.shadowFalloff, light.shadowDistance);
    g.shadowGamma = std::max(light.shadowFalloffGamma, 1e-3f);
    g.setLight(light, is, pose);
    s.kind = RasterLightSource::Kind(g.kind);
    const ProfileTable profile = _tables.profile(light, diagnostics);
    g.firstProfile = profile.first;
    g.profileThetas = profile.thetas;
    g.profilePhis = profile.phis;
    bool cameraVisible = light.cameraVisible;
    switch (is.kind) {
    case ResolvedLight::Kind::Distant:
        s.toLight = pose.toLight;
        _hasWideSun |= is.versine > narrowSun;
        s.weight = luminance(glm::abs(s.radiance)) *
                   (s.delta ? 1.0f : std::min(2.0f * pi * is.versine, pi));
        break;
    case ResolvedLight::Kind::Dome:
        s.domeToWorld = pose.domeToWorld;
        if (!addDome(s, light, images, domes)) {
            diagnostics.warn(light.path, "inputs:texture:file",
                             messages::domesTooMany(RasterDomes::maxImages));
            return;
        }
        cameraVisible &= settings.domeLightCameraVisibility;
        _hasDome = true;
        break;
    case ResolvedLight::Kind::Point: s.weight = luminance(glm::abs(s.radiance)); break;
    case ResolvedLight::Kind::Line: {
        const float length = glm::length(pose.along);
        s.toLight = pose.along;
        s.extent = 0.5f * length;
        s.weight = luminance(glm::abs(s.radiance)) * length;
        break;
    }
    default: s.shape = pose.shape; addShape(s, light, images, diagnostics);
    }
    g.category = categoryOf(light.lightLink, links);
    g.set(shLights::LIGHT_IS_SEEN, cameraVisible && !s.delta);
    g.setFilters(filters);
    if (s.atPlace()) {
        GpuLight bright = g;
        bright.radiance = s.radiance;
        s.estimate = estimateOf(bright, is.kind == ResolvedLight::Kind::Area ? &s.shape : nullptr,
                                (s.image ? s.image->mean : 1.0f) * profile.largest);
    }
    _sources.push_back(s);
    if (light.type == LightType::Dome && s.sunIrradiance != vec3(0.0f)) {
        RasterLightSource sun = s;
        sun.kind = RasterLightSource::Distant;
        sun.delta = true;
        sun.toLight = s.domeToWorld * s.sunDirection;
        sun.radiance = s.radiance * s.sunIrradiance;
        sun.weight = luminance(glm::abs(sun.radiance));
        sun.environment = nullptr;
        sun.fixed.axis2 = sun.toLight;
        sun.fixed.set(shLights::LIGHT_IS_DELTA);
        sun.fixed.set(shLights::LIGHT_OF_DOME);
        sun.fixed.set(shLights::LIGHT_IS_SEEN, false);
        _sources.push_back(sun);
    }
}

/// The image, and where the harmonics light surfaces also those and the dominant light.
/// @returns whether there was room for the image
bool RasterLights::addDome(RasterLightSource& s, const Light& light, LightImages& images,
                           RasterDomes& domes) {
    GpuLight& g = s.fixed;
    int layer = -1, first = -1;
    if (light.hasImage()) {
        s.environment = images.environment(light);
        layer = domes.layer(s.environment);
        if (layer < 0) return false;
        if (_domeMethods.count("harmonics") > 0 || _domeMethods.count("prefiltered") > 0) {
            const SkyHarmonics& sky = domes.harmonics(s.environment);
            std::vector<vec4> values;
            for (const vec3& c : sky.irradiance)
                values.emplace_back(c, 0.0f);
            first = _tables.add(values);
            s.sunDirection = sky.sunDirection;
            s.sunIrradiance = sky.sunIrradiance;
        }
    }
    g.domeRadiance = s.radiance;
    g.domeLayer = float(layer);
    g.domeSamples = float(_domeSamples);
    g.firstHarmonic = first;
    return true;
}

/// The parameters of a shape, and a rect's image.
void RasterLights::addShape(RasterLightSource& s, const Light& light, LightImages& images,
                            Diagnostics& diagnostics) {
    GpuLight& g = s.fixed;
    if (const RectImage* image = _tables.rect(light, images, diagnostics)) {
        s.image = image;
        g.firstValue = image->first;
        g.columns = image->width;
        g.rows = image->height;
    }
    vec3 low(INFINITY), high(-INFINITY);
    growBounds(s.shape, low, high);
    s.extent = 0.5f * glm::length(high - low);
    s.weight = luminance(glm::abs(s.radiance)) * 0.25f * s.extent * s.extent * pi;
    s.position = s.shape.origin;
}

} // namespace patina

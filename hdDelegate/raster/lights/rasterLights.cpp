#include "hdDelegate/raster/lights/rasterLights.h"

#include "hdDelegate/lights/lightShaping.h"
#include "hdDelegate/scene/lightUnits.h"
#include "materialNetwork/diagnostics.h"
#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// The rotation nearest to a transform in the order z, y, x; its scale is dropped.
mat3 rotationOf(const mat4& m) {
    const vec3 z = glm::normalize(vec3(m[2]));
    vec3 y = vec3(m[1]) - glm::dot(vec3(m[1]), z) * z;
    y = glm::normalize(y);
    vec3 x = glm::cross(y, z);
    if (glm::dot(x, vec3(m[0])) < 0.0f) x = -x;
    const mat3 r(x, y, z);
    return std::isfinite(x.x + y.x + z.x) ? r : mat3(1.0f);
}

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// @returns -1 for an empty link, which is everything
int categoryOf(const std::string& link, const std::map<std::string, int>& categories) {
    if (link.empty()) return -1;
    const auto found = categories.find(link);
    return found == categories.end() ? int(categories.size()) : found->second;
}

} // namespace

RasterLights::RasterLights(const SceneState& state, const RenderSettings& settings,
                           RasterInstances& places, float timeCode, int domeSamples,
                           const std::set<std::string>& domeMethods, LightImages& images,
                           RasterDomes& domes, const std::map<std::string, int>& categories,
                           Diagnostics& diagnostics)
    : _tables(diagnostics), _domeMethods(domeMethods), _domeSamples(domeSamples),
      _seed(uint32_t(settings.seed)), _shadows(settings.enableShadows) {
    if (!domeMethods.empty() && domeMethods.count("sampled") == 0) _domeSamples = 0;
    domes.begin();
    if (settings.enableSceneLights)
        for (const auto& item : state.lights) {
            const Light& light = *item.second;
            if (!light.visible) continue;
            if (light.type == LightType::Mesh) continue; // see RasterEmitters
            for (const RasterPlace& place : places.places(light.group))
                add(light, mat4(place.groupToWorld * exactTransformAt(light.transform, timeCode)),
                    settings, images, domes, categories, diagnostics);
        }
    _tables.upload(maxTables);
    domes.upload(_domeMethods.count("prefiltered") > 0);
}

void RasterLights::add(const Light& light, const mat4& toWorld, const RenderSettings& settings,
                       LightImages& images, RasterDomes& domes,
                       const std::map<std::string, int>& categories, Diagnostics& diagnostics) {
    Source s;
    const vec3 asked = lightRadiance(light, toWorld);
    s.radiance = glm::max(asked, vec3(0.0f));
    if (glm::any(glm::lessThan(asked, vec3(0.0f))))
        diagnostics.warn(light.path, "inputs:intensity",
                         "negative light is not supported and counts as zero");
    if (!isFinite(s.radiance) && light.normalize) s.radiance = vec3(0.0f);
    if (!isFinite(s.radiance) || !isFinite(vec3(toWorld[3]))) {
        diagnostics.warn(light.path, "inputs:intensity", "the light is not finite; it is off");
        return;
    }
    s.position = vec3(toWorld[3]);
    s.shadows = light.shadowEnable;
    s.shadowCategory = categoryOf(light.shadowLink, categories);
    GpuLight& g = s.fixed;
    g.shadowColor = vec4(light.shadowColor, 0.0f);
    g.fade = vec4(light.shadowDistance, light.shadowFalloff,
                  std::max(light.shadowFalloffGamma, 1e-3f), 1.0f);
    const LightShaping shaping(light, toWorld, nullptr);
    g.shaping = vec4(shaping.axis(), std::max(light.shapingFocus, 0.0f));
    const bool cone = light.shapingConeAuthored && light.shapingConeAngle < 180.0f;
    g.focusTint = vec4(light.shapingFocusTint, cone ? 1.0f : 0.0f);
    const float cutoff = std::max(0.0f, light.shapingConeAngle) * pi / 180.0f;
    const float softness = std::clamp(light.shapingConeSoftness, 0.0f, 1.0f);
    g.cone = vec4(cutoff * (1.0f - softness), cutoff, 0.0f, 0.0f);
    const ProfileTable profile = _tables.profile(light);
    g.table.w = float(profile.first);
    g.shapingX = vec4(shaping.x(), float(profile.thetas));
    g.shapingY = vec4(shaping.y(), float(profile.phis));
    bool cameraVisible = light.cameraVisible;
    switch (light.type) {
    case LightType::Distant: {
        s.kind = Distant;
        s.toLight = glm::normalize(vec3(toWorld[2]));
        if (!isFinite(s.toLight)) s.toLight = vec3(0.0f, 0.0f, 1.0f);
        const float halfAngle = 0.5f * std::clamp(light.angle, 0.0f, 360.0f) * pi / 180.0f;
        const float sine = std::sin(0.5f * halfAngle);
        const float gap = 2.0f * sine * sine;
        g.cone = vec4(0.0f, 0.0f, gap, 2.0f * pi * gap);
        s.delta = !(g.cone.z > 0.0f);
        _hasWideSun |= g.cone.z > narrowSun && s.radiance != vec3(0.0f);
        g.origin = vec4(s.toLight, 0.0f);
        s.weight = luminance(s.radiance) * (s.delta ? 1.0f : std::min(g.cone.w, pi));
        break;
    }
    case LightType::Dome:
        addDome(s, light, toWorld, images, domes);
        cameraVisible &= settings.domeLightCameraVisibility;
        _hasDome |= s.radiance != vec3(0.0f);
        break;
    default:
        if (!addShape(s, light, toWorld, images, diagnostics)) return;
    }
    g.axis[2].w = float(categoryOf(light.lightLink, categories));
    g.inverse[0].w = light.diffuse;
    g.inverse[1].w = light.specular;
    g.inverse[2].w = cameraVisible && !s.delta ? 1.0f : 0.0f;
    if (s.delta) g.origin.w = 1.0f;
    if (s.radiance == vec3(0.0f)) return;
    _sources.push_back(s);
    if (light.type == LightType::Dome && s.sunIrradiance != vec3(0.0f)) {
        Source sun = s;
        sun.kind = Distant;
        sun.delta = true;
        sun.toLight = s.domeToWorld * s.sunDirection;
        sun.radiance = s.radiance * s.sunIrradiance;
        sun.weight = luminance(sun.radiance);
        sun.environment = nullptr;
        sun.fixed.origin = vec4(sun.toLight, 1.0f);
        sun.fixed.cone = vec4(1.0f, 0.0f, 0.0f, 0.0f);
        sun.fixed.inverse[2].w = 0.0f;
        _sources.push_back(sun);
    }
}

/// The image, and where the harmonics light surfaces also those and the dominant light.
void RasterLights::addDome(Source& s, const Light& light, const mat4& toWorld, LightImages& images,
                           RasterDomes& domes) {
    s.kind = Dome;
    s.domeToWorld = rotationOf(toWorld);
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

/// The shapes, and the points and lines that stand for them, by the rules of LightEmitter.
bool RasterLights::addShape(Source& s, const Light& light, const mat4& toWorld, LightImages& images,
                            Diagnostics& diagnostics) {
    const bool sphere = light.type == LightType::Sphere;
    const double size = lightSizeFactor(light, toWorld);
    const double length = glm::length(glm::dvec3(vec3(toWorld[0]))) * std::abs(light.length);
    const bool stands =
        sphere ? light.treatAsPoint : light.type == LightType::Cylinder && light.treatAsLine;
    const bool thin = sphere || light.type == LightType::Cylinder;
    if (thin && (stands || (size == 0.0 && light.normalize)) && std::isfinite(size) &&
        (sphere || length > 0.0)) {
        s.kind = sphere ? Point : Line;
        s.delta = true;
        const double projected = sphere ? 0.25 : 1.0 / (piDouble * length);
        s.radiance = vec3(glm::dvec3(glm::max(lightBaseRadiance(light), vec3(0.0f))) * projected *
                          (light.normalize ? 1.0 : size));
        s.weight = luminance(s.radiance);
        if (!sphere) {
            s.toLight = vec3(toWorld[0]) * std::abs(light.length);
            s.fixed.axis[0] = vec4(glm::normalize(s.toLight), 0.0f);
            s.extent = 0.5f * float(length);
            s.weight *= float(length);
        }
        return true;
    }
    s.shape = makeAreaShape(light, toWorld);
    if (!s.shape.valid) {
        diagnostics.warn(light.path, lightSizeInput(light),
                         "the light's size is zero or not finite; the light is off");
        return false;
    }
    s.kind = Kind(int(s.shape.kind));
    GpuLight& g = s.fixed;
    if (const RectImage* image = _tables.rect(light, images)) {
        s.image = image;
        g.table = vec4(float(image->first), float(image->width), float(image->height), g.table.w);
    }
    vec3 low(INFINITY), high(-INFINITY);
    growBounds(s.shape, low, high);
    s.extent = 0.5f * glm::length(high - low);
    s.weight = luminance(s.radiance) * 0.25f * s.extent * s.extent * pi;
    for (int i = 0; i < 3; ++i) {
        g.axis[i] = vec4(s.shape.axes[i], 0.0f);
        g.inverse[i] = vec4(s.shape.inverse[i], 0.0f);
    }
    g.origin = vec4(s.shape.origin, 0.0f);
    s.position = s.shape.origin;
    return true;
}

} // namespace patina

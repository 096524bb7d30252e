#include "hdDelegate/embree/integrator.h"

#include "hdDelegate/embree/ambientOcclusion.h"
#include "hdDelegate/embree/aovWriter.h"
#include "hdDelegate/embree/path.h"
#include "hdDelegate/embree/pixelFilter.h"
#include "hdDelegate/embree/sceneLights.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int maxPassThroughs = 256; ///< surfaces that opacity lets one ray through

float luminance(const vec3& c) {
    return glm::dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}

float powerHeuristic(float a, float b) {
    if (!std::isfinite(a)) return 1.0f;
    const float aa = a * a, bb = b * b;
    return aa > 0.0f ? aa / (aa + bb) : 0.0f;
}

vec3 transmittanceOf(const MediumStack& media, float distance) {
    if (media.empty()) return vec3(1.0f);
    const vec3 a = media.absorption();
    vec3 result(1.0f); // a clear medium stays clear over an infinite distance
    for (int c = 0; c < 3; ++c)
        if (a[c] > 0.0f) result[c] = std::exp(-a[c] * distance);
    return result;
}

bool contains(const std::vector<int>& sorted, int value) {
    return std::binary_search(sorted.begin(), sorted.end(), value);
}

} // namespace

Integrator::Integrator(const EmbreeScene& scene, const SceneLights& lights,
                       const CameraRays& camera, const RenderSettings& settings,
                       const std::vector<AovSpec>& aovs)
    : _scene(scene), _lights(lights), _camera(camera), _settings(settings), _aovs(aovs),
      _filter(settings.filterRadius), _cullBack(settings.cullStyle.rfind("back", 0) == 0),
      _cullFront(settings.cullStyle.rfind("front", 0) == 0),
      _cullDoubleSided(settings.cullStyle.find("Unless") == std::string::npos) {}

void Integrator::sample(Film& film, int x, int y, uint32_t index, TraceCounters& counters) const {
    Sampler sampler(uint32_t(x), uint32_t(y), _settings.seed, index);
    const vec4 uFilm = sampler.next4();
    const vec4 uTime = sampler.next4();
    const vec2 offset = _filter.sample(vec2(uFilm));
    const vec2 pixel = vec2(x, y) + 0.5f + offset;
    const CameraRay ray = _camera.ray(pixel, vec2(uFilm.z, uFilm.w), uTime.x);
    const AovTarget target{film, x, y, glm::length(offset)};
    if (_settings.integrator == "ambientOcclusion") {
        const AmbientOcclusion occlusion{_scene, _settings.ambientOcclusionSamples};
        const float seen = occlusion.sample(ray, sampler, _aovs, target, _camera, counters.rays);
        ++counters.paths;
        film.addColor(x, y, vec3(std::max(seen, 0.0f)), seen < 0.0f ? 0.0f : 1.0f);
        return;
    }

    Path path(sampler);
    path.origin = ray.origin;
    path.direction = ray.direction;
    path.near = ray.near;
    path.far = ray.far;
    path.time = ray.time;
    path.coneWidth = ray.coneWidth;
    path.coneSpread = ray.coneSpread;
    trace(path, target, counters);
    ++counters.paths;
    film.addColor(x, y, path.radiance * _camera.camera().exposureScale, path.alpha);
}

bool Integrator::linked(int category, const Surface* surface,
                        const std::vector<int>* instance) const {
    return category == SceneLights::everything || !surface ||
           contains(surface->categories, category) || (instance && contains(*instance, category));
}

/// Light that the ray meets before `distance`: area lights, and at infinity domes and suns.
/// @returns true when the camera's ray ends on a light.
bool Integrator::addLightsAlong(Path& path, float distance) const {
    LightHit hits[8];
    const int count = _lights.set().intersect(path.origin, path.direction, path.near, distance,
                                              path.time, hits, 8);
    if (path.fromCamera()) {
        // The camera sees lights as solid shapes; every other ray passes through them, as shadow
        // rays do, so that light and BSDF samples agree.
        const LightHit* nearest = nullptr;
        for (int i = 0; i < count; ++i)
            if (_lights.info(hits[i].light).cameraVisible &&
                (!nearest || hits[i].distance < nearest->distance))
                nearest = &hits[i];
        if (!nearest) return false;
        path.radiance +=
            path.throughput * transmittanceOf(path.media, nearest->distance) * nearest->radiance;
        path.alpha = 1.0f;
        return true;
    }
    for (int i = 0; i < count; ++i) {
        const float lightPdf =
            path.specular ? 0.0f
                          : _lights.set().pdf(hits[i].light, path.vertex, path.vertexNormal,
                                              path.vertexTwoSided, path.time, hits[i]);
        addLight(path, hits[i].light, hits[i].radiance, lightPdf, hits[i].distance);
    }
    return false;
}

/// Light found by following the BSDF, weighted against what light samples would have found.
void Integrator::addLight(Path& path, int light, const vec3& radiance, float lightPdf,
                          float distance) const {
    const LightInfo& info = _lights.info(light);
    if (!linked(info.lightCategory, path.vertexSurface, path.vertexInstanceCategories)) return;
    const float weight = path.specular ? 1.0f : powerHeuristic(path.pdf, lightPdf);
    const vec3 share = path.diffuseShare * info.diffuse + path.specularShare * info.specular;
    addRadiance(path, transmittanceOf(path.media, distance) * share * radiance * weight);
}

void Integrator::addRadiance(Path& path, const vec3& radiance) const {
    vec3 contribution = path.throughput * radiance;
    if (_settings.indirectClamp > 0.0f && path.depth > 1) {
        const float l = luminance(contribution);
        if (l > _settings.indirectClamp) contribution *= _settings.indirectClamp / l;
    }
    path.radiance += contribution;
}

void Integrator::addEscaped(Path& path) const {
    for (int light : _lights.set().infiniteLights()) {
        const LightInfo& info = _lights.info(light);
        if (path.fromCamera() && (!info.cameraVisible || !info.dome)) continue;
        const vec3 radiance = _lights.set().environment(light, path.direction, path.time);
        if (path.fromCamera()) {
            path.radiance += path.throughput * radiance;
            path.alpha = 1.0f;
            continue;
        }
        if (radiance == vec3(0.0f)) continue;
        const float lightPdf =
            path.specular
                ? 0.0f
                : _lights.set().pdfInfinite(light, path.vertex, path.vertexNormal,
                                            path.vertexTwoSided, path.direction, path.time);
        addLight(path, light, radiance, lightPdf, path.media.empty() ? 0.0f : INFINITY);
    }
}

/// Light that the surface itself gives off towards the ray.
void Integrator::addEmission(Path& path, const SurfacePoint& point, const Hit& hit) const {
    const vec3 radiance = _lights.emission(point);
    if (radiance == vec3(0.0f)) return;
    const int light = path.fromCamera()
                          ? -1
                          : _lights.triangleLight(hit.surface, hit.primitive, hit.groupToWorld);
    if (light < 0) {
        addRadiance(path, radiance);
        return;
    }
    const float lightPdf =
        path.specular ? 0.0f
                      : _lights.set().pdfTriangle(light - _lights.set().lightCount(), path.vertex,
                                                  path.vertexNormal, path.vertexTwoSided,
                                                  point.shading.position);
    addLight(path, light, radiance, lightPdf, 0.0f);
}

/// The part of a light that reaches a point past everything in between.
vec3 Integrator::visibility(const Path& path, const vec3& origin, const vec3& direction,
                            float distance, const LightInfo& light, TraceCounters& counters) const {
    if (!light.castsShadows || !_settings.enableShadows) return vec3(1.0f);
    float far = distance * (1.0f - 1e-4f);
    if (light.shadowDistance > 0.0f) far = std::min(far, light.shadowDistance);
    ++counters.shadowRays;
    const bool simple = _scene.allOpaque() && light.shadowCategory == SceneLights::everything &&
                        light.shadowFalloff <= 0.0f;
    if (simple) {
        if (!_scene.occluded(origin, direction, 0.0f, far, path.time, RayShadow)) return vec3(1.0f);
        return light.shadowColor;
    }
    float through = 1.0f, near = 0.0f;
    for (int i = 0; i < maxPassThroughs && through > 0.0f; ++i) {
        Hit hit;
        if (!_scene.intersect(origin, direction, near, far, path.time, RayShadow, hit)) break;
        SurfacePoint point;
        computeSurfacePoint(hit, origin, direction, 0.0f, point);
        if (linked(light.shadowCategory, hit.surface, hit.instanceCategories)) {
            const MaterialProgram& program = *point.slot->program;
            float opacity = point.slot->opaque ? 1.0f : program.opacity(point.shading);
            if (light.shadowFalloff > 0.0f && light.shadowDistance > 0.0f) {
                const float fade = std::clamp(
                    (light.shadowDistance - hit.distance) / light.shadowFalloff, 0.0f, 1.0f);
                opacity *= std::pow(fade, std::max(light.shadowFalloffGamma, 1e-3f));
            }
            through *= 1.0f - opacity;
        }
        near = hit.distance + std::max(point.offset, hit.distance * 1e-6f);
    }
    return vec3(through) + (1.0f - through) * light.shadowColor;
}

vec3 Integrator::directLight(const Path& path, const SurfacePoint& point, const Bsdf& bsdf,
                             const Hit& hit, const vec3& u, TraceCounters& counters) const {
    const ShadingPoint& s = point.shading;
    const bool twoSided = bsdf.transmits();
    const vec3 side = glm::dot(s.viewDirection, s.geometricNormal) < 0.0f ? -s.normal : s.normal;
    LightSample light;
    if (!_lights.set().sample(s.position, side, twoSided, u, path.time, light) ||
        !(light.pdf > 0.0f))
        return vec3(0.0f);
    const LightInfo& info = _lights.info(light.light);
    if (!linked(info.lightCategory, hit.surface, hit.instanceCategories)) return vec3(0.0f);
    const BsdfEval f = bsdf.eval(light.direction);
    vec3 value = f.diffuse * info.diffuse + f.specular * info.specular;
    if (value == vec3(0.0f)) return vec3(0.0f);
    vec3 radiance = light.radiance;
    if (info.triangles) {
        radiance = _lights.triangleRadiance(light, s.position, path.time);
        if (radiance == vec3(0.0f)) return vec3(0.0f);
    }
    const float weight = light.delta ? 1.0f : powerHeuristic(light.pdf, f.pdf);
    const float away = glm::dot(light.direction, s.geometricNormal) < 0.0f ? -1.0f : 1.0f;
    const vec3 origin = s.position + s.geometricNormal * (away * point.offset);
    value *= radiance * (weight / light.pdf);
    value *= transmittanceOf(path.media, light.distance);
    return value * visibility(path, origin, light.direction, light.distance, info, counters);
}

void Integrator::trace(Path& path, const AovTarget& target, TraceCounters& counters) const {
    bool aovsWritten = _aovs.empty();
    int passed = 0;
    float travelled = 0.0f; // since the last vertex, over surfaces that were passed through
    const bool hasFiniteLights = _lights.set().hasIntersectable();
    while (true) {
        Hit hit;
        ++counters.rays;
        const bool found =
            _scene.intersect(path.origin, path.direction, path.near, path.far, path.time,
                             path.fromCamera() ? RayCamera : RayIndirect, hit);
        const float distance = found ? hit.distance : path.far;
        if (hasFiniteLights && _settings.enableSceneLights && addLightsAlong(path, distance)) break;
        if (!found) {
            addEscaped(path);
            break;
        }
        path.throughput *= transmittanceOf(path.media, hit.distance);
        travelled += hit.distance;
        SurfacePoint point;
        const float width = path.coneWidth + path.coneSpread * travelled;
        computeSurfacePoint(hit, path.origin, path.direction, width, point);
        const MaterialProgram& program = *point.slot->program;
        const ShadingPoint& s = point.shading;

        const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
        const bool culled = path.fromCamera() &&
                            (back ? cullsBack(*hit.surface->prim) : cullsFront(*hit.surface->prim));
        float opacity = culled ? 0.0f : point.slot->opaque ? 1.0f : program.opacity(s);
        if (opacity < 1.0f && !(path.sampler.random() < opacity)) {
            if (++passed > maxPassThroughs) break;
            path.origin = s.position + path.direction * std::max(point.offset, 1e-7f);
            path.near = 0.0f;
            continue;
        }
        if (path.fromCamera()) path.alpha = 1.0f;

        Bsdf bsdf;
        program.evaluate(s, bsdf);
        if (!aovsWritten) {
            writeAovs(_aovs, target, _camera, point, bsdf);
            aovsWritten = true;
        }
        addEmission(path, point, hit);
        if (path.depth >= _settings.maxDepth || _lights.hidesMaterial(hit.surface)) break;

        const vec4 uLight = path.sampler.next4();
        if (bsdf.hasNonDelta() && !_lights.set().empty())
            addRadiance(path, directLight(path, point, bsdf, hit, vec3(uLight), counters));

        const vec4 uBsdf = path.sampler.next4();
        const BsdfSample next = bsdf.sample(vec3(uBsdf), uBsdf.w);
        if (next.event == 0) break;
        path.throughput *= next.weight;
        if (!(luminance(path.throughput) > 0.0f)) break;
        const bool transmits = (next.event & sh::LOBE_TRANSMIT) != 0;
        if (transmits && program.hasInterior()) {
            if (back)
                path.media.leave(&program);
            else
                path.media.enter(&program, program.interiorAbsorption(s));
        }
        path.specular = (next.event & sh::LOBE_DELTA) != 0;
        path.pdf = next.pdf;
        path.vertex = s.position;
        path.vertexNormal = back ? -s.normal : s.normal;
        path.vertexTwoSided = bsdf.transmits();
        path.vertexSurface = hit.surface;
        path.vertexInstanceCategories = hit.instanceCategories;
        path.diffuseShare = vec3(next.diffuse ? 1.0f : 0.0f);
        path.specularShare = vec3(1.0f) - path.diffuseShare;
        if (_lights.splitsLobes() && !path.specular) {
            const BsdfEval f = bsdf.eval(next.wi);
            const vec3 sum = f.diffuse + f.specular;
            for (int c = 0; c < 3; ++c)
                path.diffuseShare[c] = sum[c] > 0.0f ? f.diffuse[c] / sum[c] : 0.5f;
            path.specularShare = vec3(1.0f) - path.diffuseShare;
        }

        ++path.depth;
        if (path.depth > _settings.rouletteDepth) {
            const float survive = std::min(
                0.95f, std::max({path.throughput.x, path.throughput.y, path.throughput.z}));
            if (path.sampler.random() >= survive) break;
            path.throughput /= survive;
        }
        const float away = glm::dot(next.wi, s.geometricNormal) < 0.0f ? -1.0f : 1.0f;
        path.origin = s.position + s.geometricNormal * (away * point.offset);
        path.direction = next.wi;
        path.near = 0.0f;
        path.far = INFINITY;
        path.coneWidth = width;
        path.coneSpread = std::min(1.0f, path.coneSpread + 0.5f * next.roughness);
        travelled = 0.0f;
    }
}

} // namespace patina

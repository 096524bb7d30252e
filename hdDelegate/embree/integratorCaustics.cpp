// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include "hdDelegate/embree/caustics/photonPass.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

// Caustics from photons (Jensen 1996): light that comes to surfaces that are no glass by way of
// glass. docs/design/pathTracer.md has the partition between photons and paths.

namespace patina {

namespace {

/// Cosines of shading normals that go to zero leave flux without a bound.
constexpr float maxCosineRatio = 8.0f;

float cosine(const vec3& a, const vec3& b) {
    return std::abs(glm::dot(a, b));
}

float ratio(float a, float b) {
    return b > 0.0f ? std::min(a / b, maxCosineRatio) : 0.0f;
}

} // namespace

float PhotonPass::radiusOf(int block) {
    constexpr float alpha = 2.0f / 3.0f;
    float square = firstRadius * firstRadius;
    for (int k = 1; k <= block; ++k)
        square *= (float(k) + alpha) / (float(k) + 1.0f);
    return std::sqrt(square);
}

bool Integrator::bendPhoton(Path& path, const SurfacePoint& point, bool first) const {
    const ShadingPoint& s = point.shading;
    const MaterialProgram& program = *point.slot->program;
    Bsdf bsdf;
    program.evaluate(s, bsdf);
    const vec4 u = path.sampler.next4();
    const BsdfSample next = bsdf.sample(vec3(u), u.w);
    if (next.event == 0) return false;
    const float arrives = first ? 1.0f : cosine(s.viewDirection, s.geometricNormal);
    const float leaves = cosine(next.wi, s.geometricNormal);
    if ((next.event & sh::LOBE_DELTA) != 0) {
        // Lobes are in flux form: what a path from the camera weighs is what a photon weighs, but
        // for the squeeze of the beam.
        path.throughput *= next.weight *
                           (cosine(s.viewDirection, s.normal) / std::max(arrives, 1e-6f)) *
                           ratio(leaves, cosine(next.wi, s.normal)) *
                           ((next.event & sh::LOBE_TRANSMIT) != 0 ? next.eta * next.eta : 1.0f);
    } else {
        // As a path from the camera weighs this vertex, so that lobes need not be reciprocal.
        ShadingPoint seen = s;
        seen.viewDirection = next.wi;
        Bsdf back;
        program.evaluate(seen, back);
        const BsdfEval f = back.eval(s.viewDirection);
        path.throughput *=
            (f.diffuse + f.specular) * (leaves / (next.pdf * std::max(arrives, 1e-6f)));
    }
    if (!(luminance(path.throughput) > 0.0f)) return false;
    if ((next.event & sh::LOBE_TRANSMIT) != 0)
        path.media.cross(program, s, priorityOf(*point.hit), bsdf.ior() * s.surroundingIor);
    path.origin = point.departure(next.wi);
    path.direction = next.wi;
    path.near = 0.0f;
    path.far = INFINITY;
    path.rays = (next.event & sh::LOBE_TRANSMIT) != 0 ? RayTransmission : RaySpecular;
    ++path.depth;
    return true;
}

Photon Integrator::photon(const CausticCasters& casters, uint32_t block, uint32_t index,
                          uint32_t count, TraceCounters& counters) const {
    Photon result;
    Path path(Sampler(block, 0x9406f0d5u, _settings.seed, index));
    Sampler& sampler = path.sampler;
    const vec4 where = sampler.next4();
    path.time = 0.0f;
    CausticCasters::Point start = casters.sample(vec2(where), vec2(where.z, where.w), path.time);
    if (!(start.pdf > 0.0f)) return result;
    LightSample light;
    if (!_lights.set().sample(start.position, start.normal, false, sampler.next3(), path.time,
                              light) ||
        !(light.pdf > 0.0f))
        return result;
    const LightInfo& info = _lights.info(light.light);
    if (!(glm::dot(light.direction, start.normal) > 0.0f) ||
        !linked(info.lightCategory, start.hit.surface, start.hit.instanceCategories))
        return result;
    start.hit.distance = 1.0f;
    SurfacePoint point;
    computeSurfacePoint(start.hit, start.position + light.direction, -light.direction, 0.0f, point);
    if (_lights.hidesMaterial(start.hit.surface)) return result;
    float presence = 1.0f;
    if (!point.slot->opaque) presence = point.slot->program->opacity(point.shading);
    vec3 radiance = light.radiance;
    if (info.triangles) radiance = _lights.triangleRadiance(light, start.position, path.time);
    if (!(presence > 0.0f) || radiance == vec3(0.0f)) return result;
    const vec3 seen = visibility(path, path.media, point.departure(light.direction),
                                 light.direction, light.distance, info, counters);
    if (seen == vec3(0.0f)) return result;
    path.throughput = radiance * seen * (presence / (light.pdf * start.pdf * float(count)));
    if (!bendPhoton(path, point, true)) return result;
    const float first = luminance(path.throughput);

    for (int passed = 0; path.depth < _settings.maxDepth;) {
        Hit hit;
        ++counters.rays;
        if (!_scene.intersect(path.origin, path.direction, path.near, path.far, path.time,
                              path.rays, hit))
            break;
        if (!path.media.empty() || _scene.fillsSpace())
            if (traverseMedia(path, hit.distance, counters) != Step::Arrives) break;
        computeSurfacePoint(hit, path.origin, path.direction, 0.0f, point);
        const MaterialProgram& program = *point.slot->program;
        if (program.jitters()) point.shading.seed = sampler.randomBits();
        if (_scene.ranksMedia() && !isThere(path.media, point, hit)) {
            if (++passed > maxPassThroughs) break;
            path.origin = point.shading.position + path.direction * std::max(point.offset, 1e-7f);
            continue;
        }
        vec3 transmittance(1.0f);
        const float opacity =
            point.slot->opaque ? 1.0f : program.opacity(point.shading, &transmittance);
        if (opacity < 1.0f && !(sampler.random() < opacity)) {
            path.throughput *= transmittance;
            if (++passed > maxPassThroughs || path.throughput == vec3(0.0f)) break;
            if (program.passThroughEnters())
                path.media.cross(program, point.shading, priorityOf(hit));
            path.origin = point.shading.position + path.direction * std::max(point.offset, 1e-7f);
            continue;
        }
        if (!castsCaustics(program)) {
            if (!path.media.empty()) break;
            const vec3& n = point.shading.geometricNormal;
            result.position = point.shading.position;
            result.towards = -path.direction;
            result.normal = glm::dot(n, path.direction) > 0.0f ? -n : n;
            result.flux = path.throughput;
            result.bounces = path.depth;
            break;
        }
        if (!bendPhoton(path, point, false)) break;
        const float survives = std::min(1.0f, luminance(path.throughput) / first);
        if (survives < 1.0f) {
            if (!(sampler.random() < survives)) break;
            path.throughput /= survives;
        }
    }
    const vec3& flux = result.flux;
    if (!std::isfinite(flux.x + flux.y + flux.z)) result.flux = vec3(0.0f);
    return result;
}

vec3 Integrator::photonLight(const Path& path, const SurfacePoint& point, const Bsdf& bsdf,
                             float width) const {
    constexpr float flat = 0.9f;  // cosine between surfaces that share photons
    constexpr float thick = 0.3f; // of the radius, off the surface's plane
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
    const vec3 n = back ? -s.geometricNormal : s.geometricNormal;
    // Seen through rough glass the cone is wide, and the photons of it many. A pixel is enough.
    const vec3 eye = vec3(_camera.worldToCamera() * vec4(s.position, 1.0f));
    const float pixel = _camera.pixelSpread() * (_camera.orthographic() ? 1.0f : glm::length(eye));
    const float radius = std::max(_photons->radius * std::min(width, pixel), point.offset);
    vec3 sum(0.0f);
    _photons->map.visit(s.position, radius, [&](const Photon& photon) {
        // Of one side of the surface, unless it lets light through.
        const float facing = glm::dot(photon.normal, n);
        if (bsdf.transmits() ? std::abs(facing) < flat : facing < flat) return;
        if (std::abs(glm::dot(photon.position - s.position, n)) > thick * radius) return;
        if (photon.bounces + path.depth >= _settings.maxDepth) return;
        const BsdfEval f = bsdf.eval(photon.towards);
        const float c = cosine(photon.towards, s.geometricNormal);
        if (c > 0.0f) sum += (f.diffuse + f.specular) * photon.flux / std::max(c, 1e-3f);
    });
    return sum / (pi * radius * radius);
}

void Integrator::meetCaustics(Path& path, const SurfacePoint& point, const Bsdf& bsdf,
                              float width) const {
    if (castsCaustics(*point.slot->program)) {
        path.throughCasters = path.onPhotons;
        return;
    }
    path.onPhotons = path.throughCasters = false;
    if (!bsdf.hasNonDelta() || !path.media.empty()) return;
    path.onPhotons = true;
    addRadiance(path, photonLight(path, point, bsdf, width));
}

} // namespace patina

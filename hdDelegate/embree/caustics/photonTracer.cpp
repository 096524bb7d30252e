// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/caustics/photonTracer.h"

#include "hdDelegate/embree/vertex.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

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

bool PhotonTracer::bend(Path& path, const SurfacePoint& point, bool first) const {
    const ShadingPoint& s = point.shading;
    const MaterialProgram& program = *point.slot->program;
    Bsdf bsdf;
    program.evaluate(s, bsdf);
    const vec4 u = path.sampler.next4();
    const BsdfSample next = bsdf.sample(vec3(u), u.w);
    if (next.event == 0) return false;
    const bool transmits = (next.event & sh::LOBE_TRANSMIT) != 0;
    const float arrives = first ? 1.0f : cosine(s.viewDirection, s.geometricNormal);
    const float leaves = cosine(next.wi, s.geometricNormal);
    if ((next.event & sh::LOBE_DELTA) != 0) {
        // Lobes are in flux form: what a path from the camera weighs is what a photon weighs, but
        // for the squeeze of the beam.
        path.throughput *=
            next.weight * (cosine(s.viewDirection, s.normal) / std::max(arrives, 1e-6f)) *
            ratio(leaves, cosine(next.wi, s.normal)) * (transmits ? next.eta * next.eta : 1.0f);
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
    if (transmits)
        path.media.cross(program, s, _scene.priorityOf(*point.hit), bsdf.ior() * s.surroundingIor);
    path.origin = point.departure(next.wi);
    path.direction = next.wi;
    path.near = 0.0f;
    path.far = INFINITY;
    path.rays = transmits ? RayTransmission : RaySpecular;
    ++path.depth;
    return true;
}

bool PhotonTracer::begin(const CausticCasters& casters, uint32_t count, Path& path, Hit& hit,
                         SurfacePoint& point, TraceCounters& counters) const {
    const vec4 where = path.sampler.next4();
    CausticCasters::Point start = casters.sample(vec2(where), vec2(where.z, where.w), path.time);
    if (!(start.pdf > 0.0f)) return false;
    hit = start.hit;
    LightSample light;
    if (!_lights.set().sample(start.position, start.normal, false, path.sampler.next3(), path.time,
                              light) ||
        !(light.pdf > 0.0f))
        return false;
    const LightInfo& info = _lights.info(light.light);
    if (!(glm::dot(light.direction, start.normal) > 0.0f) ||
        !isLinked(info.lightCategory, hit.surface, hit.instanceCategories))
        return false;
    hit.distance = 1.0f;
    computeSurfacePoint(hit, start.position + light.direction, -light.direction, 0.0f, point);
    if (_lights.hidesMaterial(hit.surface)) return false;
    float presence = 1.0f;
    if (!point.slot->opaque) presence = point.slot->program->opacity(point.shading);
    const vec3 radiance = _lights.radiance(light, start.position, path.time);
    if (!(presence > 0.0f) || radiance == vec3(0.0f)) return false;
    const vec3 seen = _shadows.seen(
        info, {point.departure(light.direction), light.direction, light.distance, path.time},
        path.media, path.sampler, counters);
    if (seen == vec3(0.0f)) return false;
    path.throughput = radiance * seen * (presence / (light.pdf * start.pdf * float(count)));
    return true;
}

Photon PhotonTracer::trace(const CausticCasters& casters, uint32_t block, uint32_t index,
                           uint32_t count, TraceCounters& counters) const {
    Photon result;
    Path path(Sampler(block, 0x9406f0d5u, _settings.seed, index));
    Hit hit;
    SurfacePoint point;
    if (!begin(casters, count, path, hit, point, counters) || !bend(path, point, true))
        return result;
    const float first = luminance(path.throughput);

    for (int passed = 0; path.depth < _settings.maxDepth;) {
        ++counters.rays;
        if (!_scene.intersect(path.origin, path.direction, path.near, path.far, path.time,
                              path.rays, hit))
            break;
        if (!path.media.empty() || _scene.fillsSpace())
            if (_media.traverse(path, hit.distance, counters) != Path::Step::Arrives) break;
        computeSurfacePoint(hit, path.origin, path.direction, 0.0f, point);
        const MaterialProgram& program = *point.slot->program;
        if (program.jitters()) point.shading.seed = path.sampler.randomBits();
        if (_scene.ranksMedia() && !isThere(path.media, point, hit)) {
            if (++passed > maxPassThroughs) break;
            path.pass(point);
            continue;
        }
        vec3 transmittance(1.0f);
        const float opacity =
            point.slot->opaque ? 1.0f : program.opacity(point.shading, &transmittance);
        if (opacity < 1.0f && !(path.sampler.random() < opacity)) {
            path.throughput *= transmittance;
            if (++passed > maxPassThroughs || path.throughput == vec3(0.0f)) break;
            if (program.passThroughEnters())
                path.media.cross(program, point.shading, _scene.priorityOf(hit));
            path.pass(point);
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
        if (!bend(path, point, false)) break;
        const float survives = std::min(1.0f, luminance(path.throughput) / first);
        if (survives < 1.0f) {
            if (!(path.sampler.random() < survives)) break;
            path.throughput /= survives;
        }
    }
    const vec3& flux = result.flux;
    if (!std::isfinite(flux.x + flux.y + flux.z)) result.flux = vec3(0.0f);
    return result;
}

} // namespace patina

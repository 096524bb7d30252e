#include "hdDelegate/embree/media/randomWalk.h"

#include "hdDelegate/embree/media/freeFlight.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// A walk of so many steps is about 30 mean free paths deep; what is left of it comes out where it
/// went in, which nobody can tell from where it should.
constexpr int maxSteps = 1024;
constexpr int maxFaces = 64; ///< other surfaces that one step passes
constexpr int stratifiedSteps = 4;
constexpr int lookEvery = 4;
constexpr int rouletteSteps = 16;
constexpr float maxPassage = 4.0f; ///< bounds the weight of walks that leave an open mesh

/// van de Hulst's s = sqrt((1 - albedo) / (1 - albedo g)) of a half space with this albedo: the
/// root of (1 - s)(1 - 0.139 s) / (1 + 1.17 s) = albedo.
float inverseSimilarity(float albedo) {
    const float b = 1.139f + 1.17f * albedo;
    // The root in the form without cancellation.
    return 2.0f * (1.0f - albedo) /
           (b + std::sqrt(std::max(b * b - 0.556f * (1.0f - albedo), 0.0f)));
}

bool sameObject(const Hit& a, const Hit& b) {
    return a.surface == b.surface && a.instanced == b.instanced &&
           (!a.instanced || a.groupToWorld == b.groupToWorld);
}

} // namespace

WalkMedium walkMedium(const SubsurfaceEntry& entry, float shortest) {
    WalkMedium result;
    const float g =
        entry.anisotropy == entry.anisotropy
            ? std::clamp(entry.anisotropy, -sh::PHASE_ANISOTROPY_MAX, sh::PHASE_ANISOTROPY_MAX)
            : 0.0f;
    result.anisotropy = g;
    const float longest = std::max({entry.radius.x, entry.radius.y, entry.radius.z});
    for (int c = 0; c < 3; ++c) {
        const float s = inverseSimilarity(std::clamp(entry.color[c], 0.0f, 1.0f));
        const float albedo = std::clamp((1.0f - s * s) / (1.0f - g * s * s), 0.0f, 1.0f);
        // Channels of a thousandth of the longest way scatter on the spot already.
        const float least = std::max({1e-3f * longest, shortest, 1e-12f});
        const float radius = std::clamp(entry.radius[c], least, std::max(least, 1e12f));
        result.extinction[c] = 1.0f / radius;
        result.scattering[c] = albedo / radius;
    }
    return result;
}

WalkExit walkBeneath(const EmbreeScene& scene, const WalkMedium& medium, const Hit& entry,
                     bool back, vec3 origin, vec3 direction, Sampler& sampler, uint64_t& rays) {
    WalkExit exit;
    const bool flat = entry.surface->shape == Surface::Shape::Triangles;
    const auto phase = sh::phaseHenyeyGreensteinSetup(medium.anisotropy);
    vec3 passage(1.0f); // the weight if nothing were absorbed
    int inside = 1;     // parts of the object around the walk
    for (int step = 0; step < maxSteps; ++step) {
        vec4 u;
        if (step < stratifiedSteps) {
            u = sampler.next4();
        } else {
            u.x = sampler.random();
            u.y = sampler.random();
            u.z = sampler.random();
            u.w = sampler.random();
        }
        const FreeFlight ahead =
            sampleFreeFlight(medium.extinction, medium.scattering, exit.weight, INFINITY, vec2(u));
        // Where nothing scatters, the walk goes straight on to the boundary and is absorbed.
        const float reach = ahead.scattered ? ahead.distance : INFINITY;
        // From inside, some part of the object lies ahead in every direction. To look so far at
        // each step would be slow; who is outside stays there for a while.
        const bool looks = !ahead.scattered || step < stratifiedSteps || step % lookEvery == 0;
        Hit hit;
        bool out = false, seen = !looks;
        float near = 0.0f;
        for (int i = 0; i < maxFaces; ++i) {
            ++rays;
            if (!scene.intersect(origin, direction, near, seen ? reach : INFINITY, entry.time,
                                 RayIndirect, hit))
                break;
            near = hit.distance * (1.0f + 1e-6f) + 1e-7f * glm::length(origin);
            if (!sameObject(hit, entry)) continue;
            if (step == 0 && flat && hit.primitive == entry.primitive) continue;
            seen = true;
            if (hit.distance >= reach) break;
            SurfacePoint point;
            computeSurfacePoint(hit, origin, direction, 0.0f, point);
            const bool leaves = (glm::dot(point.shading.geometricNormal, direction) > 0.0f) != back;
            inside += leaves ? -1 : 1;
            if (inside <= 0) {
                out = true;
                break;
            }
        }
        if (!seen || (!out && !ahead.scattered)) {
            exit.open = true;
            exit.weight = glm::min(passage, vec3(maxPassage));
            return exit;
        }
        const float travelled = out ? hit.distance : ahead.distance;
        passage *=
            weighFreeFlight(medium.extinction, medium.extinction, exit.weight, travelled, !out)
                .weight;
        exit.weight *=
            weighFreeFlight(medium.extinction, medium.scattering, exit.weight, travelled, !out)
                .weight;
        if (out) {
            exit.found = true;
            exit.hit = hit;
            exit.origin = origin;
            exit.direction = direction;
            return exit;
        }
        const float brightest = std::max({exit.weight.x, exit.weight.y, exit.weight.z});
        if (!(brightest > 0.0f)) break;
        if (step >= rouletteSteps) {
            const float survive = std::min(1.0f, brightest);
            if (sampler.random() >= survive) {
                exit.weight = vec3(0.0f);
                break;
            }
            exit.weight /= survive;
            passage /= survive;
        }
        origin += direction * travelled;
        direction = glm::normalize(
            sh::phaseHenyeyGreensteinSample(phase, -direction, vec3(u.z, u.w, 0.0f)).wi);
    }
    return exit;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/randomWalk.h"

#include "hdDelegate/embree/media/freeFlight.h"

#include "shaders/closure.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// A walk of so many steps is about 30 mean free paths deep; what is left of it comes out where it
/// went in, which nobody can tell from where it should.
constexpr int maxSteps = 1024;
constexpr int maxFaces = 64;       ///< other surfaces that one step passes
constexpr int stratifiedSteps = 4; ///< that know how far the boundary is before they scatter
constexpr int searchInterval = 4;
constexpr int rouletteSteps = 16;
constexpr float maxPassage = 4.0f;  ///< bounds the weight of walks that leave an open mesh
constexpr float worthOf = 0.25f;    ///< of its colour: weight below which a walk may end
constexpr float guideLength = 1.2f; ///< of the profile that directions turn by: near 1 it is a beam
constexpr float grazing = 0.01f;    ///< cosine from which on startWalk() looks no closer

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

/// Of those strategies that only pay where little comes back.
float darkness(const WalkMedium& medium) {
    const float left = 1.0f - std::max({medium.color.x, medium.color.y, medium.color.z});
    return left * left;
}

/// Where a step would leave the object, and how many of its parts are around before.
struct Boundary {
    bool seen = false; ///< some part of the object lies ahead
    bool out = false;
    Hit hit; ///< where it leaves
    int inside = 1;
};

/// Follows a step over faces of the object that stay inside.
class BoundarySearch {
public:
    BoundarySearch(const WorldRays& scene, const Hit& entry, bool back, uint64_t& rays)
        : _scene(scene), _entry(entry), _back(back), _rays(rays) {}

    /// @param reach beyond which nothing is looked for, but for some part of the object
    /// @param searches whether that is wanted
    /// @param inside parts around the origin
    Boundary find(const vec3& origin, const vec3& direction, float reach, bool searches, bool first,
                  int inside) {
        Boundary result;
        result.seen = !searches;
        result.inside = inside;
        _count = 0;
        const bool flat = _entry.surface->shape == Surface::Shape::Triangles;
        float near = 0.0f;
        for (int i = 0; i < maxFaces; ++i) {
            ++_rays;
            if (!_scene.intersect(origin, direction, near, result.seen ? reach : INFINITY,
                                  _entry.time, RayIndirect, result.hit))
                break;
            near = result.hit.distance * (1.0f + 1e-6f) + 1e-7f * glm::length(origin);
            if (!sameObject(result.hit, _entry)) continue;
            if (first && flat && result.hit.primitive == _entry.primitive) continue;
            result.seen = true;
            if (result.hit.distance >= reach) break;
            SurfacePoint point;
            computeSurfacePoint(result.hit, origin, direction, 0.0f, point);
            const bool leaves =
                (glm::dot(point.shading.geometricNormal, direction) > 0.0f) != _back;
            result.inside += leaves ? -1 : 1;
            _crossed[_count++] = {result.hit.distance, result.inside};
            if (result.inside <= 0) {
                result.out = true;
                break;
            }
        }
        return result;
    }

    /// Parts of the object around a place on the way that find() looked along.
    int insideAt(float distance, int before) const {
        int inside = before;
        for (int i = 0; i < _count && _crossed[i].distance < distance; ++i)
            inside = _crossed[i].inside;
        return inside;
    }

private:
    struct Crossing {
        float distance;
        int inside;
    };
    const WorldRays& _scene;
    const Hit& _entry;
    bool _back;
    uint64_t& _rays;
    Crossing _crossed[maxFaces];
    int _count = 0;
};

/// A step of known reach.
struct Step {
    bool leaves = false;
    float distance = 0.0f;
    vec3 weight{0.0f}, passage{0.0f}; ///< as of FreeFlight; passage if nothing were absorbed
};

/// Leaves with a chance that follows from what either outcome is worth: the transmittance, against
/// the medium's colour for what scatters. The channels are strategies of the balance heuristic.
/// @param end of the way; infinite where it does not leave
Step chooseStep(const WalkMedium& medium, const vec3& throughput, float end, const vec2& u) {
    Step step;
    const float sum = throughput.x + throughput.y + throughput.z;
    if (!(sum > 0.0f) || !std::isfinite(sum)) return step;
    const vec3 share = throughput / sum;
    const vec3 left = transmittance(medium.extinction, end);
    // Of what does not leave, `scatters` is drawn for each part that a ray would scatter.
    const vec3 worth = glm::max(left + (1.0f - left) * medium.color, vec3(1e-30f));
    const vec3 leave = left / worth, scatters = medium.color / worth;
    int channel = 0;
    for (float below = share.x; channel < 2 && u.x >= below;)
        below += share[++channel];
    while (channel > 0 && !(share[channel] > 0.0f))
        --channel;
    step.leaves = u.y < leave[channel];
    if (step.leaves) {
        step.distance = end;
        const float density = glm::dot(share, leave);
        step.passage = step.weight = left / density;
        return step;
    }
    const float v = std::min((u.y - leave[channel]) / (1.0f - leave[channel]), 0.99999994f);
    const float t = -std::log1p(-v * (1.0f - left[channel])) / medium.extinction[channel];
    step.distance = std::min(t, end);
    const vec3 ahead = transmittance(medium.extinction, step.distance);
    const float density = glm::dot(share, scatters * medium.extinction * ahead);
    if (!(density > 0.0f)) return step;
    step.weight = medium.scattering * ahead / density;
    step.passage = medium.extinction * ahead / density;
    return step;
}

/// A direction that light scatters into. A part of them is drawn by a profile that turns to the
/// surface (Dwivedi 1982), which the weight makes up for.
vec3 turn(const sh::PhaseHenyeyGreensteinLobe& phase, const vec3& direction, const vec3& outside,
          float guided, const vec2& u, float uPart, float& weight) {
    const float scale = std::log((guideLength + 1.0f) / (guideLength - 1.0f));
    vec3 result;
    if (uPart < guided) {
        const float cosine =
            std::clamp(guideLength - (guideLength + 1.0f) * std::exp(-u.x * scale), -1.0f, 1.0f);
        const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
        vec3 x, y;
        sh::completeBasis(outside, x, y);
        const float phi = sh::TWO_PI * u.y;
        result = x * (sine * std::cos(phi)) + y * (sine * std::sin(phi)) + outside * cosine;
    } else {
        result = sh::phaseHenyeyGreensteinSample(phase, -direction, vec3(u, 0.0f)).wi;
    }
    result = glm::normalize(result);
    if (!(guided > 0.0f)) return result;
    const float density = sh::phaseHenyeyGreensteinEval(phase, -direction, result).pdf;
    const float turned =
        1.0f / (sh::TWO_PI * scale * (guideLength - std::min(glm::dot(result, outside), 1.0f)));
    weight = density / ((1.0f - guided) * density + guided * turned);
    return result;
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
        result.color[c] = std::clamp(entry.color[c], 0.0f, 1.0f);
        const float s = inverseSimilarity(result.color[c]);
        const float albedo = std::clamp((1.0f - s * s) / (1.0f - g * s * s), 0.0f, 1.0f);
        // Channels of a thousandth of the longest way scatter on the spot already.
        const float minimum = std::max({1e-3f * longest, shortest, 1e-12f});
        const float radius = std::clamp(entry.radius[c], minimum, std::max(minimum, 1e12f));
        result.extinction[c] = 1.0f / radius;
        result.scattering[c] = albedo / radius;
    }
    return result;
}

WalkStart startWalk(const WalkMedium& medium, const vec2& u, float uPart) {
    WalkStart start;
    const float guided = 0.2f * darkness(medium);
    const float scale = std::log((1.0f + grazing) / grazing);
    // Cosines come with a density of 1 / ((cosine + grazing) scale).
    const float cosine = uPart < guided ? grazing * std::expm1(u.x * scale) : std::sqrt(u.x);
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const float phi = sh::TWO_PI * u.y;
    start.direction = vec3(sine * std::cos(phi), sine * std::sin(phi), std::min(cosine, 1.0f));
    const float density = (1.0f - guided) * 2.0f * cosine + guided / ((cosine + grazing) * scale);
    start.weight = guided > 0.0f ? 2.0f * cosine / density : 1.0f;
    return start;
}

WalkExit walkBeneath(const WorldRays& scene, const WalkMedium& medium, const Hit& entry, bool back,
                     const vec3& outside, vec3 origin, vec3 direction, Sampler& sampler,
                     uint64_t& rays) {
    WalkExit exit;
    const auto phase = sh::phaseHenyeyGreensteinSetup(medium.anisotropy);
    const float guided = 0.85f * darkness(medium);
    BoundarySearch boundaries(scene, entry, back, rays);
    vec3 passage(1.0f); // the weight if nothing were absorbed
    int inside = 1;     // parts of the object around the walk
    for (int step = 0; step < maxSteps; ++step) {
        const bool early = step < stratifiedSteps;
        vec4 u;
        if (early) {
            u = sampler.next4();
        } else {
            u.x = sampler.random();
            u.y = sampler.random();
            u.z = sampler.random();
            u.w = sampler.random();
        }
        Step next;
        Boundary ahead;
        if (early) {
            ahead = boundaries.find(origin, direction, INFINITY, true, step == 0, inside);
            next =
                chooseStep(medium, exit.weight, ahead.out ? ahead.hit.distance : INFINITY, vec2(u));
            if (ahead.out && !next.leaves)
                ahead.inside = boundaries.insideAt(next.distance, inside);
        } else {
            const FreeFlight flight = sampleFreeFlight(medium.extinction, medium.scattering,
                                                       exit.weight, INFINITY, vec2(u));
            // Where nothing scatters, the walk goes straight on to the boundary and is absorbed.
            // From inside, some part of the object lies ahead in every direction. To look so far
            // at each step would be slow; who is outside stays there for a while.
            const bool searches = !flight.scattered || step % searchInterval == 0;
            ahead =
                boundaries.find(origin, direction, flight.scattered ? flight.distance : INFINITY,
                                searches, false, inside);
            next.leaves = ahead.out || !flight.scattered;
            next.distance = ahead.out ? ahead.hit.distance : flight.distance;
            const auto weigh = [&](const vec3& scattering) {
                return weighFreeFlight(medium.extinction, scattering, exit.weight, next.distance,
                                       !ahead.out)
                    .weight;
            };
            next.passage = weigh(medium.extinction);
            next.weight = weigh(medium.scattering);
        }
        inside = ahead.inside;
        if (!ahead.seen || (next.leaves && !ahead.out)) {
            exit.open = true;
            exit.weight = glm::min(passage, vec3(maxPassage));
            return exit;
        }
        passage *= next.passage;
        exit.weight *= next.weight;
        if (next.leaves) {
            exit.found = true;
            exit.hit = ahead.hit;
            exit.origin = origin;
            exit.direction = direction;
            return exit;
        }
        const float brightest = std::max({exit.weight.x, exit.weight.y, exit.weight.z});
        if (!(brightest > 0.0f)) break;
        const vec3 worth = exit.weight / glm::max(worthOf * medium.color, vec3(1e-6f));
        const float survive = std::min(
            {1.0f, std::max({worth.x, worth.y, worth.z}), step < rouletteSteps ? 1.0f : brightest});
        if (survive < 1.0f) {
            if (sampler.random() >= survive) {
                exit.weight = vec3(0.0f);
                break;
            }
            exit.weight /= survive;
            passage /= survive;
        }
        origin += direction * next.distance;
        const float share = early ? guided : 0.0f;
        float turned = 1.0f;
        direction = turn(phase, direction, outside, share, vec2(u.z, u.w),
                         share > 0.0f ? sampler.random() : 1.0f, turned);
        exit.weight *= turned;
        passage *= turned;
    }
    return exit;
}

} // namespace patina

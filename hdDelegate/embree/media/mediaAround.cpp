// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/mediaAround.h"

#include <algorithm>
#include <vector>

namespace patina {

namespace {

constexpr int maxCrossings = 256;

/// An object seen from inside: how often, and how far away its surface is.
struct Candidate {
    const MaterialProgram* program;
    int priority;
    Medium medium;
    float ior;
    int votes = 0;
    float distance = 0.0f;

    bool isOf(const MaterialProgram* other, int rank) const {
        return program == other && priority == rank;
    }
};

float iorOf(const MaterialProgram& program, const ShadingPoint& point) {
    Bsdf bsdf;
    program.evaluate(point, bsdf);
    return bsdf.ior();
}

/// Notes every object that a ray leaves without having entered it.
void castRay(const EmbreeScene& scene, const vec3& point, const vec3& direction, float time,
             std::vector<Candidate>& candidates) {
    using Object = std::pair<const MaterialProgram*, int>; // and its priority
    std::vector<Object> entered, seen;
    float near = 0.0f;
    for (int i = 0; i < maxCrossings; ++i) {
        Hit hit;
        if (!scene.intersect(point, direction, near, INFINITY, time, RayIndirect, hit)) return;
        SurfacePoint surface;
        computeSurfacePoint(hit, point, direction, 0.0f, surface);
        near = hit.distance + std::max(surface.offset, hit.distance * 1e-6f);
        const MaterialProgram* program = surface.slot->program.get();
        const Object object(program, scene.priorityOf(hit));
        if (!(object.second > 0 ? program->encloses() : program->hasInterior())) continue;
        const ShadingPoint& s = surface.shading;
        if (glm::dot(s.geometricNormal, s.viewDirection) >= 0.0f) {
            entered.push_back(object);
            continue;
        }
        const auto open = std::find(entered.begin(), entered.end(), object);
        if (open != entered.end()) {
            entered.erase(open);
            continue;
        }
        // Inside several objects of one material is inside of it once.
        if (std::find(seen.begin(), seen.end(), object) != seen.end()) continue;
        seen.push_back(object);
        auto known = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
            return c.isOf(program, object.second);
        });
        if (known == candidates.end())
            known = candidates.insert(candidates.end(),
                                      {program, object.second, program->interior(s),
                                       object.second > 0 ? iorOf(*program, s) : 1.0f});
        ++known->votes;
        known->distance += hit.distance;
    }
}

} // namespace

MediumStack mediaAround(const EmbreeScene& scene, const vec3& point, float time) {
    MediumStack result;
    if (!scene.hasMedia() && !scene.ranksMedia()) return result;
    // Off the axes, so that rays do not run along edges of what people build; each with its
    // opposite, so that a sheet is seen by no more than half of them.
    const vec3 directions[] = {
        {0.31f, 0.87f, 0.38f}, {-0.74f, 0.22f, 0.63f}, {0.58f, -0.69f, 0.44f}};
    constexpr int count = 6;
    std::vector<Candidate> candidates;
    for (const vec3& direction : directions) {
        castRay(scene, point, glm::normalize(direction), time, candidates);
        castRay(scene, point, -glm::normalize(direction), time, candidates);
    }
    for (Candidate& c : candidates)
        if (c.votes > 0) c.distance /= float(c.votes);
    std::stable_sort(
        candidates.begin(), candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.distance > b.distance; });
    for (const Candidate& c : candidates)
        if (2 * c.votes > count) result.enter(c.program, c.medium, c.priority, c.ior);
    return result;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/caustics/causticCasters.h"

#include "base/limits.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// Makes values their running sums over their sum.
void accumulate(std::vector<float>& values) {
    double sum = 0.0;
    for (float& v : values) {
        sum += v;
        v = float(sum);
    }
    for (float& v : values)
        v = float(v / sum);
    if (!values.empty()) values.back() = 1.0f;
}

size_t find(const std::vector<float>& sums, float u) {
    const auto at = std::upper_bound(sums.begin(), sums.end(), u);
    return std::min(size_t(at - sums.begin()), sums.size() - 1);
}

float chance(const std::vector<float>& sums, size_t i) {
    return sums[i] - (i > 0 ? sums[i - 1] : 0.0f);
}

/// Twice the area, along the normal of the winding.
vec3 cross(const Surface& surface, unsigned triangle, const mat4& place) {
    const uvec3& t = surface.topology().triangles[triangle];
    vec3 p[3];
    for (int k = 0; k < 3; ++k)
        p[k] = vec3(place * vec4(surface.placed.positions[0][t[k]], 1.0f));
    return glm::cross(p[1] - p[0], p[2] - p[0]);
}

} // namespace

Hit hitOn(const Surface* surface, unsigned primitive, const GroupPlace& place, vec2 uv) {
    Hit hit;
    hit.surface = surface;
    hit.primitive = primitive;
    hit.u = uv.x;
    hit.v = uv.y;
    hit.groupToWorld = place.toWorld;
    hit.instanced = !surface->prim->group.empty();
    for (const InstanceStep& step : place.steps)
        if (hit.stepCount < Hit::maxSteps) hit.steps[hit.stepCount++] = step;
    return hit;
}

bool castsCaustics(const MaterialProgram& program) {
    if (!program.hasTransmission() || program.isThinWalled() || program.isFibre() ||
        program.hasSubsurface() || program.disperses() || program.jitters() ||
        program.ir().walkedLayers > 0)
        return false;
    const auto& lobes = program.ir().lobes;
    return std::none_of(lobes.begin(), lobes.end(), [](const LobeTemplate& l) {
        return l.diffuse || l.walks || l.thin || l.passThrough;
    });
}

CausticCasters::CausticCasters(const EmbreeScene& scene)
    : _placements(scene.places().placements()) {
    for (const Surface* surface : scene.surfaces().with(castsCaustics)) {
        if (surface->shape != Surface::Shape::Triangles || surface->shared) {
            _complete = false;
            continue;
        }
        Shape shape{surface, {}, {}};
        for (unsigned t = 0; t < surface->topology().triangles.size(); ++t) {
            if (!castsCaustics(*surface->material(t).program)) continue;
            const float area = 0.5f * glm::length(cross(*surface, t, mat4(1.0f)));
            if (!(area > 0.0f) || !std::isfinite(area)) continue;
            shape.triangles.push_back(t);
            shape.sums.push_back(area);
            shape.area += area;
        }
        if (shape.triangles.empty()) continue;
        if (double(_placed.size()) + scene.places().count(surface->prim->group) >
            double(limitOf(Limit::lights))) {
            _complete = false;
            continue;
        }
        accumulate(shape.sums);
        for (const GroupPlace& place : scene.places().places(surface->prim->group)) {
            const float size = std::cbrt(std::abs(glm::determinant(glm::mat3(place.toWorld))));
            const float area = shape.area * size * size;
            if (!(area > 0.0f) || !std::isfinite(area)) continue;
            _placed.push_back({int(_shapes.size()), place});
            _sums.push_back(area);
        }
        _shapes.push_back(std::move(shape));
    }
    accumulate(_sums);
}

CausticCasters::Point CausticCasters::sample(vec2 u, vec2 which, float time) const {
    Point point;
    const size_t p = find(_sums, which.x);
    const Placed& placed = _placed[p];
    const Shape& shape = _shapes[size_t(placed.shape)];
    const size_t i = find(shape.sums, which.y);
    const unsigned triangle = shape.triangles[i];
    const Surface& surface = *shape.surface;
    const vec3 n = cross(surface, triangle, placed.place.toWorld);
    const float twice = glm::length(n);
    if (!(twice > 0.0f)) return point;
    // Uniform over the triangle (Turk 1990).
    const float root = std::sqrt(u.x);
    const vec2 uv(root * (1.0f - u.y), root * u.y);
    point.hit = hitOn(&surface, triangle, placed.place, uv);
    point.hit.time = time;
    const uvec3& t = surface.topology().triangles[triangle];
    const auto& positions = surface.placed.positions[0];
    point.position =
        vec3(placed.place.toWorld * vec4(positions[t[0]] * (1.0f - uv.x - uv.y) +
                                             positions[t[1]] * uv.x + positions[t[2]] * uv.y,
                                         1.0f));
    const bool mirrored =
        surface.flipNormals != (glm::determinant(glm::mat3(placed.place.toWorld)) < 0.0f);
    point.normal = n * ((mirrored ? -1.0f : 1.0f) / twice);
    point.pdf = chance(_sums, p) * chance(shape.sums, i) / (0.5f * twice);
    return point;
}

} // namespace patina

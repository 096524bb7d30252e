// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/shadows/rasterShadows.h"

#include "hdDelegate/lights/areaShape.h"
#include "base/maths.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

std::vector<vec3> corners(const vec3& low, const vec3& high) {
    std::vector<vec3> out;
    for (int i = 0; i < 8; ++i)
        out.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    return out;
}

/// World to a space with -z along `direction`, turned about it.
mat4 looking(const vec3& from, const vec3& direction, float turn) {
    const float angle = 2.0f * pi * turn;
    const vec3 helper = std::fabs(direction.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0);
    const vec3 x = glm::normalize(glm::cross(direction, helper));
    const vec3 y = glm::cross(x, direction);
    return glm::lookAt(from, from + direction, x * std::cos(angle) + y * std::sin(angle));
}

/// @returns what ShadowView::worldToLight is for a sample of a flat emitter
mat4 planeOf(const GpuLight& light, const ShadowBounds& bounds) {
    const vec3 n = light.normal, from = light.sampled;
    const vec3 x =
        glm::normalize(glm::cross(n, std::fabs(n.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0)));
    const vec3 y = glm::cross(n, x);
    // A few roundings of the numbers that corners are computed from.
    const auto largest = [](const vec3& v) {
        const vec3 a = glm::abs(v);
        return std::max({a.x, a.y, a.z});
    };
    const float place =
        std::max({largest(from), glm::length(light.axis0), glm::length(light.axis1)});
    const float thin = std::max(4e-6f * place, 1e-30f);
    // Further away the same error is too small an angle to be seen.
    const vec3 receivers = 0.5f * (bounds.receiverMin + bounds.receiverMax);
    const float wide = std::max(1e-2f * (place + glm::length(receivers - from)), 1e-30f);
    mat4 m(1.0f);
    for (int i = 0; i < 3; ++i)
        m[i] = vec4(x[i] / wide, y[i] / wide, n[i] / thin, 0.0f);
    m[3] =
        vec4(-glm::dot(x, from) / wide, -glm::dot(y, from) / wide, -glm::dot(n, from) / thin, 1.0f);
    return m;
}

/// About a place, around all receivers.
struct Cone {
    vec3 axis{0.0f, -1.0f, 0.0f};
    float tangent = INFINITY; ///< of half its angle
    float nearest = 0.0f;     ///< along the axis, of the receivers
};

/// @param beside how far from the place it may begin
Cone coneOf(const vec3& from, float beside, const ShadowBounds& bounds) {
    Cone cone;
    const std::vector<vec3> around =
        corners(bounds.receiverMin - beside, bounds.receiverMax + beside);
    vec3 sum(0.0f);
    for (const vec3& p : around) {
        const float away = glm::length(p - from);
        if (!(away > 0.0f)) return cone;
        sum += (p - from) / away;
    }
    if (!(glm::length(sum) > 0.1f)) return cone;
    cone.axis = glm::normalize(sum);
    cone.tangent = 0.0f;
    cone.nearest = INFINITY;
    for (const vec3& p : around) {
        const float along = glm::dot(p - from, cone.axis);
        cone.nearest = std::min(cone.nearest, along);
        cone.tangent =
            std::max(cone.tangent,
                     along > 0.0f ? glm::length(p - from - along * cone.axis) / along : INFINITY);
    }
    return cone;
}

/// @returns up to half a texel each way, as a part of the map's width
vec2 shiftOf(vec2 turn, int mapSize) {
    return (vec2(turn.y, glm::fract(turn.y * 89.0f)) - 0.5f) / float(mapSize);
}

} // namespace

float shadowTangent(const vec3& from, float beside, const ShadowBounds& bounds) {
    return coneOf(from, beside, bounds).tangent;
}

ShadowView distantShadow(const vec3& toLight, vec2 turn, const ShadowBounds& bounds, int mapSize) {
    const mat4 view = looking(vec3(0.0f), -toLight, turn.x);
    vec3 low(INFINITY), high(-INFINITY);
    for (const vec3& p : corners(bounds.receiverMin, bounds.receiverMax)) {
        const vec3 q = vec3(view * vec4(p, 1.0f));
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    const float side = std::max(high.x - low.x, high.y - low.y) * 1.02f + 1e-6f;
    // Surfaces further towards the light are drawn at the map's near end (GL_DEPTH_CLAMP): numbers
    // are for where shadows fall.
    const float nearest = high.z + 8.0f * std::max(high.z - low.z, side);
    float casters = high.z;
    for (const vec3& p : corners(bounds.sceneMin, bounds.sceneMax))
        casters = std::max(casters, (view * vec4(p, 1.0f)).z);
    high.z = std::min(casters, nearest);
    const float pad = 0.01f * (high.z - low.z) + 1e-6f;
    const vec2 c = 0.5f * vec2(low + high) + side * shiftOf(turn, mapSize);
    const float h = 0.5f * side;
    ShadowView out;
    out.worldToMap =
        glm::ortho(c.x - h, c.x + h, c.y - h, c.y + h, -high.z - pad, -low.z + pad) * view;
    out.towards = vec4(toLight, 0.0f);
    out.clampsNear = true;
    return out;
}

int ShadowPlan::enoughFor(int pixels, int mapSize) {
    constexpr int texelsPerPixel = 4, smallest = 256; // what casts is no coarser in small images
    while (mapSize / 2 >= std::max(texelsPerPixel * pixels, smallest))
        mapSize /= 2;
    return mapSize;
}

void ShadowPlan::cast(GpuLight& light, int category, vec2 turn, const ShadowBounds& bounds,
                      int maximum) {
    const int first = int(views.size());
    const int maps = castOnto(light, category, turn, bounds, maximum);
    if (maps == 0) return;
    light.firstMap = first;
    light.maps = maps;
    light.fibreMaps = fibres ? castOnto(light, category, turn, bounds.ofFibres(), maximum) : 0;
}

int ShadowPlan::castOnto(const GpuLight& light, int category, vec2 turn, const ShadowBounds& bounds,
                         int maximum) {
    const auto full = [&](int more) { return int(views.size()) + more > maximum; };
    const int kind = light.kind;
    const bool flat = kind == shLights::LIGHT_TRIANGLE || isFlatShape(kind);
    const bool atPlace = light.is(shLights::LIGHT_AT_PLACE);
    const auto cast = [&](const mat4& worldToMap, bool clampsNear) {
        ShadowView view{worldToMap, vec4(light.sampled, atPlace ? 1.0f : 0.0f), category,
                        clampsNear};
        if (kind == shLights::SHAPE_SPHERE) {
            view.own = ShadowView::Sphere;
            const mat3 inverse(light.inverse0, light.inverse1, light.inverse2);
            view.worldToLight = mat4(inverse) * glm::translate(mat4(1.0f), -light.origin);
        } else if (flat) {
            view.own = ShadowView::Plane;
            view.worldToLight = planeOf(light, bounds);
        }
        views.push_back(view);
    };
    if (!atPlace) {
        if (full(1)) return 0;
        cast(distantShadow(light.sampled, turn, bounds, mapSize).worldToMap, true);
        return 1;
    }
    const vec3 from = light.sampled;
    const vec3 center = 0.5f * (bounds.receiverMin + bounds.receiverMax);
    const float radius = 0.5f * glm::length(bounds.receiverMax - bounds.receiverMin);
    const float distance = glm::length(center - from);
    const float reach = distance + radius, minimum = std::max(1e-3f * reach, 1e-6f);
    const auto frustum = [&](float tangent, float nearest) {
        const float n = nearest * tangent;
        const vec2 shift = 2.0f * n * shiftOf(turn, mapSize);
        return glm::frustum(shift.x - n, shift.x + n, shift.y - n, shift.y + n, nearest,
                            reach * 1.01f);
    };
    const Cone cone = coneOf(from, 0.0f, bounds);
    // Better coarse than none, where there is no room.
    if (cone.tangent <= (full(6) ? 4.0f : 1.0f) * ShadowView::widestTangent) {
        if (full(1)) return 0;
        // Numbers are for where shadows fall, but of fading shadows, which are looked for on all of
        // the way.
        const bool clamps = !(light.shadowDistance > 0.0f);
        const float nearest = clamps ? std::max(0.95f * cone.nearest, minimum) : minimum;
        cast(frustum(1.02f * cone.tangent, nearest) * looking(from, cone.axis, turn.x), clamps);
        return 1;
    }
    if (full(6)) return 0;
    const vec3 directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    // A little wider than a face of the cube, for offsets and filters at its edges. A small body
    // that glows hides its own far side, however near.
    for (const vec3& d : directions)
        cast(frustum(1.02f, minimum) * looking(from, d, 0.0f), kind == shLights::LIGHT_TRIANGLE);
    return 6;
}

} // namespace patina

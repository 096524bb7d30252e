// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/lightEstimate.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

float LightEstimate::towards(const vec3& center, float ball) const {
    const vec3 v = shLights::estimateFrom(place, along, center);
    const float away = std::max({glm::length(v), ball, 1e-20f});
    float cosine = 1.0f;
    if (start >= -1.0f) {
        // The brightest direction to the ball.
        const float within = std::asin(std::min(ball / away, 1.0f));
        const float angle = std::acos(std::clamp(glm::dot(v / away, axis), -1.0f, 1.0f));
        cosine = std::cos(std::max(angle - within, 0.0f));
    }
    return shLights::estimateAt(power, radius, least, away) *
           shLights::estimateTowards(cosine, start, slope, radius / away);
}

LightEstimate estimateOf(const GpuLight& light, const AreaShape* shape, float brighter) {
    LightEstimate e;
    e.place = light.origin;
    const float radiance = luminance(glm::abs(light.radiance)) * brighter *
                           std::max(std::fabs(light.diffuse), std::fabs(light.specular));
    if (shape) {
        const float a = glm::length(light.axis0), b = glm::length(light.axis1),
                    c = glm::length(light.axis2);
        // As large as it is seen at most, and half of its sides.
        float area = shape->area, longer = a, wide = b;
        vec3 side = light.axis0;
        switch (light.kind) {
        case shLights::SHAPE_SPHERE: {
            const float least = std::min({a, b, c});
            area = pi * a * b * c / std::max(least, 1e-30f);
            longer = std::max({a, b, c});
            side = longer == a ? light.axis0 : longer == b ? light.axis1 : light.axis2;
            wide = a + b + c - longer - least;
            break;
        }
        case shLights::SHAPE_CYLINDER:
            longer = 0.5f * a;
            side = 0.5f * side;
            wide = std::max(b, c);
            area = 4.0f * longer * wide;
            break;
        default:
            if (light.kind == shLights::SHAPE_RECT) side *= 0.5f, longer *= 0.5f, wide *= 0.5f;
            if (wide > longer) {
                side = light.kind == shLights::SHAPE_RECT ? 0.5f * light.axis1 : light.axis1;
                std::swap(longer, wide);
            }
        }
        if (longer > 0.0f) e.along = side * std::max(1.0f - wide / longer, 0.0f);
        vec3 low(INFINITY), high(-INFINITY);
        growBounds(*shape, low, high);
        e.radius = 0.5f * glm::length(high - low);
        e.power = radiance * area;
        e.least = area / pi; // where all is bright, irradiance is pi times the radiance
        e.found = light.is(shLights::LIGHT_IS_DELTA) ? 0.0f : 1.0f;
        if (shape->flat) {
            e.axis = shape->normal;
            e.start = 0.0f;
        }
    } else if (light.kind == shLights::LIGHT_LINE) {
        const float half = 0.5f / light.density;
        e.power = radiance * 2.0f * half;
        e.radius = half;
        e.along = light.axis0 * half;
        e.least = 1e-3f * half * half;
    } else {
        e.power = radiance;
    }
    if (light.is(shLights::LIGHT_HAS_CONE) && light.coneEnd < (e.start >= -1.0f ? 0.5f * pi : pi)) {
        const float end = std::cos(light.coneEnd);
        e.axis = light.shapingAxis;
        e.start = end;
        e.slope = 1.0f / std::max(std::cos(light.coneStart) - end, 1e-3f);
    }
    e.least = std::max(e.least, 1e-12f);
    if (!std::isfinite(e.power)) e.power = 0.0f;
    return e;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/freeFlight.h"

#include <cmath>

namespace patina {

using glm::vec3;

vec3 transmittance(const vec3& extinction, float distance) {
    vec3 result(1.0f);
    for (int c = 0; c < 3; ++c)
        if (extinction[c] > 0.0f) result[c] = std::exp(-extinction[c] * distance);
    return result;
}

vec3 emissionAlong(const vec3& emission, const vec3& extinction, float distance) {
    vec3 result(0.0f);
    for (int c = 0; c < 3; ++c) {
        if (!(emission[c] > 0.0f)) continue;
        const float depth = extinction[c] * distance;
        // A clear medium that glows without end would be infinitely bright; it is left dark.
        if (extinction[c] > 0.0f && depth > 1e-4f)
            result[c] = emission[c] * -std::expm1(-depth) / extinction[c];
        else if (std::isfinite(distance))
            result[c] = emission[c] * distance;
    }
    return result;
}

FreeFlight sampleFreeFlight(const vec3& extinction, const vec3& scattering, const vec3& throughput,
                            float end, const glm::vec2& u) {
    FreeFlight result;
    result.distance = end;
    const float sum = throughput.x + throughput.y + throughput.z;
    if (scattering == vec3(0.0f) || !(sum > 0.0f) || !std::isfinite(sum))
        return weighFreeFlight(extinction, scattering, throughput, end, false);
    const vec3 share = throughput / sum;
    int channel = 0;
    for (float below = share.x; channel < 2 && u.x >= below;)
        below += share[++channel];
    while (channel > 0 && !(share[channel] > 0.0f)) // rounding ran past the last one in use
        --channel;
    const float t = -std::log1p(-u.y) / extinction[channel]; // clear: infinity, or NaN at u.y = 0
    if (t < end) {
        result.scattered = true;
        result.distance = t;
    }
    return weighFreeFlight(extinction, scattering, throughput, result.distance, result.scattered);
}

FreeFlight weighFreeFlight(const vec3& extinction, const vec3& scattering, const vec3& throughput,
                           float distance, bool scattered) {
    FreeFlight result;
    result.distance = distance;
    result.scattered = scattered;
    const vec3 left = transmittance(extinction, distance);
    const float sum = throughput.x + throughput.y + throughput.z;
    if (scattering == vec3(0.0f) || !(sum > 0.0f) || !std::isfinite(sum)) {
        result.weight = left;
        return result;
    }
    const float density = glm::dot(throughput / sum, scattered ? extinction * left : left);
    result.weight = density > 0.0f ? (scattered ? scattering * left : left) / density : vec3(0.0f);
    return result;
}

} // namespace patina

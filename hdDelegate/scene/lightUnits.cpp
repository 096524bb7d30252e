// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/lightUnits.h"

#include "hdDelegate/scene/motionSteps.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace patina {

namespace {

// The Planckian locus in Rec.709 at 1000, 1500 ... 10000 K, scaled so that the largest is 1 and
// kept inside the gamut.
constexpr int knotCount = 19;
constexpr float knots[knotCount][3] = {
    {1.0f, 0.027490f, 0.0f},      {1.0f, 0.149664f, 0.0f},      {1.0f, 0.256644f, 0.008095f},
    {1.0f, 0.372033f, 0.067450f}, {1.0f, 0.476725f, 0.153601f}, {1.0f, 0.570376f, 0.259196f},
    {1.0f, 0.653480f, 0.377155f}, {1.0f, 0.726878f, 0.501606f}, {1.0f, 0.791543f, 0.628050f},
    {1.0f, 0.848462f, 0.753228f}, {1.0f, 0.898581f, 0.874905f}, {1.0f, 0.942771f, 0.991642f},
    {0.906947f, 0.890456f, 1.0f}, {0.828247f, 0.841838f, 1.0f}, {0.765791f, 0.801896f, 1.0f},
    {0.715255f, 0.768579f, 1.0f}, {0.673683f, 0.740423f, 1.0f}, {0.638992f, 0.716359f, 1.0f},
    {0.609681f, 0.695588f, 1.0f},
};

vec3 knot(int index) {
    const float* k = knots[std::clamp(index, 0, knotCount - 1)];
    return vec3(k[0], k[1], k[2]);
}

using dvec3 = glm::dvec3;

dvec3 column(const mat4& m, int i, double scale) {
    return dvec3(m[i].x, m[i].y, m[i].z) * scale;
}

bool equalAxes(const dvec3& a, const dvec3& b, const dvec3& c) {
    const double aa = glm::dot(a, a), tolerance = 1e-6 * aa;
    return std::abs(glm::dot(b, b) - aa) <= tolerance &&
           std::abs(glm::dot(c, c) - aa) <= tolerance && std::abs(glm::dot(a, b)) <= tolerance &&
           std::abs(glm::dot(a, c)) <= tolerance && std::abs(glm::dot(b, c)) <= tolerance;
}

double ellipsoidArea(const dvec3& a, const dvec3& b, const dvec3& c) {
    if (equalAxes(a, b, c)) return 4.0 * piDouble * glm::dot(a, a);
    // dA = |cofactor(M) n| domega over the unit sphere; midpoints in z and angle.
    const dvec3 bc = glm::cross(b, c), ca = glm::cross(c, a), ab = glm::cross(a, b);
    constexpr int rows = 128, columns = 128;
    double sum = 0.0;
    for (int i = 0; i < rows; ++i) {
        const double z = 1.0 - 2.0 * (i + 0.5) / rows, s = std::sqrt(1.0 - z * z);
        for (int k = 0; k < columns; ++k) {
            const double phi = 2.0 * piDouble * (k + 0.5) / columns;
            sum += glm::length(bc * (s * std::cos(phi)) + ca * (s * std::sin(phi)) + ab * z);
        }
    }
    return 4.0 * piDouble * sum / (rows * columns);
}

double cylinderArea(const dvec3& along, const dvec3& b, const dvec3& c) {
    // Periodic, so that equal steps converge at once.
    constexpr int steps = 512;
    const dvec3 ab = glm::cross(along, b), ac = glm::cross(along, c);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double phi = 2.0 * piDouble * i / steps;
        sum += glm::length(ac * std::cos(phi) - ab * std::sin(phi));
    }
    return 2.0 * piDouble * sum / steps;
}

double distantFactor(double degrees) {
    if (!(degrees > 0.0)) return 1.0;
    const double half = std::min(degrees, 360.0) * piDouble / 360.0;
    const double s = std::sin(half);
    return half <= 0.5 * piDouble ? piDouble * s * s : piDouble * (2.0 - s * s);
}

} // namespace

vec3 blackbodyColor(float kelvin) {
    if (std::isnan(kelvin)) kelvin = 6500.0f;
    const float x = std::clamp((kelvin - 1000.0f) / 500.0f, 0.0f, float(knotCount - 1));
    const int i = std::min(int(x), knotCount - 2);
    const float t = x - float(i);
    const vec3 p0 = knot(i - 1), p1 = knot(i), p2 = knot(i + 1), p3 = knot(i + 2);
    const vec3 rgb = p1 + 0.5f * t *
                              ((p2 - p0) + t * ((2.0f * p0 - 5.0f * p1 + 4.0f * p2 - p3) +
                                                t * (3.0f * (p1 - p2) + p3 - p0)));
    const float y = luminance(rgb);
    return glm::max(rgb / y, vec3(0.0f));
}

mat4 transformAt(const MotionTransform& transform, float time, const dvec3& origin) {
    if (transform.empty()) return seenFrom(origin, dmat4(1.0));
    if (!transform.moves()) return seenFrom(origin, transform.first());
    const SampleSpan span = sampleSpan(transform.times, time);
    const mat4 a = seenFrom(origin, transform.values[span.index]);
    if (span.fraction <= 0.0f) return a;
    return a * (1.0f - span.fraction) +
           seenFrom(origin, transform.values[span.index + 1]) * span.fraction;
}

dmat4 exactTransformAt(const MotionTransform& transform, float time) {
    if (transform.empty()) return dmat4(1.0);
    if (!transform.moves()) return transform.first();
    const SampleSpan span = sampleSpan(transform.times, time);
    const dmat4& a = transform.values[span.index];
    if (span.fraction <= 0.0f) return a;
    const double share = double(span.fraction);
    return a * (1.0 - share) + transform.values[span.index + 1] * share;
}

std::string lightSizeInput(const Light& l) {
    struct Input {
        const char* name;
        float value;
    };
    const auto named = [](std::initializer_list<Input> inputs) -> std::string {
        for (const Input& input : inputs)
            if (input.value == 0.0f || !std::isfinite(input.value))
                return std::string("inputs:") + input.name;
        return "xformOpOrder";
    };
    switch (l.type) {
#define PATINA_LIGHT(Type, word, schemas, hydra)                                                   \
    case LightType::Type: break;
        // area lights have a row with more columns
#define PATINA_AREA_LIGHT(Type, word, schemas, hydra, number, flat, size, area, ...)               \
    case LightType::Type: return named({__VA_ARGS__});
        // one case per row
#include "hdDelegate/scene/lightTypes.inc"
    }
    return "xformOpOrder";
}

vec3 lightSize(const Light& l) {
    switch (l.type) {
#define PATINA_LIGHT(Type, word, schemas, hydra)                                                   \
    case LightType::Type: break;
        // area lights have a row with more columns
#define PATINA_AREA_LIGHT(Type, word, schemas, hydra, number, flat, size, area, ...)               \
    case LightType::Type: return size;
        // one case per row
#include "hdDelegate/scene/lightTypes.inc"
    }
    return vec3(1.0f);
}

double lightSizeFactor(const Light& light, const mat4& toWorld) {
    if (light.type == LightType::Distant) return distantFactor(light.angle);
    const vec3 size = lightSize(light);
    const dvec3 a = column(toWorld, 0, size.x), b = column(toWorld, 1, size.y);
    [[maybe_unused]] const dvec3 c = column(toWorld, 2, size.z);
    switch (light.type) {
#define PATINA_LIGHT(Type, word, schemas, hydra)                                                   \
    case LightType::Type: break;
        // area lights have a row with more columns
#define PATINA_AREA_LIGHT(Type, word, schemas, hydra, number, flat, size, area, ...)               \
    case LightType::Type: return area;
        // one case per row
#include "hdDelegate/scene/lightTypes.inc"
    }
    return 1.0;
}

vec3 lightBaseRadiance(const Light& light) {
    vec3 radiance = light.color * (light.intensity * std::exp2(light.exposure));
    if (light.enableColorTemperature) radiance *= blackbodyColor(light.colorTemperature);
    return radiance;
}

vec3 lightRadiance(const Light& light, const mat4& toWorld) {
    const vec3 base = lightBaseRadiance(light);
    return light.normalize ? vec3(glm::dvec3(base) / lightSizeFactor(light, toWorld)) : base;
}

} // namespace patina

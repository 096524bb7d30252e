// SPDX-License-Identifier: Apache-2.0
#pragma once

// Small scenes of lights, and Monte Carlo estimates with their confidence.

#include "hdDelegate/lights/lightSet.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <random>

namespace patina {

constexpr double testPi = 3.14159265358979323846;

/// An estimate passes when it is within this many standard errors: two-sided significance 7e-6.
constexpr double testSigmas = 4.5;

struct Estimate {
    double mean = 0.0, error = 0.0, deviation = 0.0;
    bool agrees(double exact, double slack = 0.0) const {
        return std::abs(mean - exact) <= testSigmas * error + slack * std::abs(exact) + 1e-12;
    }
};

inline Estimate estimate(int count, const std::function<double()>& draw) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < count; ++i) {
        const double x = draw();
        sum += x;
        squares += x * x;
    }
    Estimate e;
    e.mean = sum / count;
    e.deviation = std::sqrt(std::max(0.0, squares / count - e.mean * e.mean));
    e.error = e.deviation / std::sqrt(double(count));
    return e;
}

class Random {
public:
    explicit Random(uint32_t seed) : _engine(seed) {}
    float operator()() { return float(_engine() >> 8) * 0x1p-24f; }
    vec3 cube() {
        const float x = (*this)(), y = (*this)();
        return vec3(x, y, (*this)());
    }
    vec3 direction() {
        const float z = 1.0f - 2.0f * (*this)(), phi = 2.0f * float(testPi) * (*this)();
        const float s = std::sqrt(std::max(0.0f, 1.0f - z * z));
        return vec3(s * std::cos(phi), s * std::sin(phi), z);
    }

private:
    std::mt19937 _engine;
};

inline std::shared_ptr<Light> makeLight(LightType type, const mat4& transform = mat4(1.0f)) {
    auto light = std::make_shared<Light>();
    light->path = "/light";
    light->type = type;
    light->transform = MotionTransform(transform);
    return light;
}

struct LightScene {
    Diagnostics diagnostics;
    LightImages images{[](const std::string&, const std::string&, const std::string&,
                          const std::string&) { return ImageRGB(); }};
    LightSetInput input;
    std::unique_ptr<LightSet> set;

    LightScene() = default;
    explicit LightScene(LightImages::Loader loader) : images(std::move(loader)) {}
    const LightSet& build() {
        set = std::make_unique<LightSet>(input, images, diagnostics);
        return *set;
    }
    void setTriangles(std::vector<LightTriangle> triangles) {
        input.glowing.clear();
        input.triangleCount = 0;
        LightTrianglePlace place;
        place.triangles = std::make_shared<std::vector<LightTriangle>>(std::move(triangles));
        input.add(place);
    }
    const LightSet& build(std::shared_ptr<Light> light) {
        input.lights = {{std::move(light), mat4(1.0f)}};
        return build();
    }
};

/// Irradiance at a point by sampling lights.
inline Estimate irradiance(const LightSet& set, const vec3& point, const vec3& normal, int count,
                           uint32_t seed, float time = 0.0f) {
    Random random(seed);
    return estimate(count, [&] {
        LightSample s;
        const vec3 u = random.cube();
        if (!set.sample(point, normal, false, u, time, s)) return 0.0;
        return double(s.radiance.y) * std::max(0.0f, glm::dot(s.direction, normal)) / s.pdf;
    });
}

/// The same by rays in all directions.
inline Estimate irradianceByRays(const LightSet& set, const vec3& point, const vec3& normal,
                                 int count, uint32_t seed, float time = 0.0f) {
    Random random(seed);
    return estimate(count, [&] {
        const vec3 d = random.direction();
        LightHit hits[16];
        double sum = set.environment(d, time).y;
        const int found = set.intersect(point, d, 0.0f, INFINITY, time, hits, 16);
        for (int i = 0; i < found; ++i)
            sum += hits[i].radiance.y;
        return sum * std::max(0.0f, glm::dot(d, normal)) * 4.0 * testPi;
    });
}

/// Irradiance from a polygon of radiance 1 that is wholly above the horizon (Lambert 1760).
inline double polygonIrradiance(const std::vector<vec3>& corners, const vec3& point,
                                const vec3& normal) {
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(glm::dvec3(corners[i]) - glm::dvec3(point));
        const glm::dvec3 b =
            glm::normalize(glm::dvec3(corners[(i + 1) % corners.size()]) - glm::dvec3(point));
        const glm::dvec3 c = glm::cross(a, b);
        sum += glm::normalize(c) * std::atan2(glm::length(c), glm::dot(a, b));
    }
    return 0.5 * std::abs(glm::dot(sum, glm::dvec3(normal)));
}

} // namespace patina

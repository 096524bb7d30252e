// SPDX-License-Identifier: Apache-2.0
#pragma once

// Small scenes of lights, and Monte Carlo estimates with their confidence.

#include "hdDelegate/lights/lightSet.h"
#include "shaders/tests/estimate.h"

#include <glm/gtc/matrix_transform.hpp>

#include <functional>
#include <memory>

namespace patina {

using test::agree;
using test::estimate;
using Estimate = test::Mean;
using test::Random;

constexpr double testPi = test::pi;

inline const LightType areaTypes[] = {LightType::Sphere, LightType::Rect, LightType::Disk,
                                      LightType::Cylinder};

inline mat4 at(float x, float y, float z) {
    return glm::translate(mat4(1.0f), vec3(x, y, z));
}

inline mat4 turned(double angle, const vec3& axis) {
    return glm::rotate(mat4(1.0f), float(angle), glm::normalize(axis));
}

inline std::shared_ptr<Light> makeLight(LightType type, const mat4& transform = mat4(1.0f)) {
    auto light = std::make_shared<Light>();
    light->path = "/light";
    light->type = type;
    light->transform = MotionTransform(transform);
    return light;
}

/// At a place of an image of the sky.
inline vec3 latlongDirection(float u, float v) {
    const float longitude = float(testPi) * (1.0f - 2.0f * u), theta = float(testPi) * v;
    return vec3(std::sin(theta) * std::sin(longitude), std::cos(theta),
                std::sin(theta) * std::cos(longitude));
}

/// A triangle overhead, and what it shines by.
inline LightTriangle slantedTriangle() {
    LightTriangle t;
    t.vertices[0] = vec3(-1.0f, 1.0f, -1.0f);
    t.vertices[1] = vec3(2.0f, 1.5f, -0.5f);
    t.vertices[2] = vec3(0.2f, 0.8f, 1.4f);
    return t;
}

inline std::shared_ptr<ImageRGB> image(int width, int height,
                                       const std::function<vec3(int, int)>& pixel) {
    auto result = std::make_shared<ImageRGB>();
    result->width = width;
    result->height = height;
    result->valid = true;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result->pixels.push_back(pixel(x, y));
    return result;
}

/// Shows the same image for every file, and counts.
inline LightImages::Loader loaderOf(std::shared_ptr<ImageRGB> shown, int* loaded = nullptr) {
    return [=](const std::string&, const std::string&, const std::string&, const std::string&) {
        if (loaded) ++*loaded;
        return shown ? *shown : ImageRGB();
    };
}

inline std::shared_ptr<Light> makeDome(const std::string& file,
                                       const mat4& transform = mat4(1.0f)) {
    auto light = makeLight(LightType::Dome, transform);
    light->textureFile = file;
    return light;
}

struct LightScene {
    Diagnostics diagnostics;
    LightImages images{loaderOf(nullptr)};
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
        input.lights.clear();
        add(std::move(light));
        return build();
    }
    void add(std::shared_ptr<Light> light) {
        input.lights.push_back({std::move(light), mat4(1.0f)});
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

/// The density of samples of a light at infinity, the first of a set.
inline float pdfTowards(const LightSet& set, const vec3& direction, const vec3& normal,
                        bool twoSided = false, const vec3& point = vec3(0.0f)) {
    return set.pdfInfinite(0, point, normal, twoSided, set.place(0, direction, 0.0f), 0.0f);
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

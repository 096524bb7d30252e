// SPDX-License-Identifier: Apache-2.0
// Lists of lights for cells of space, the estimates that they are made by, and lights in an image.
#include "base/maths.h"
#include "hdDelegate/lights/resolvedLight.h"
#include "hdDelegate/raster/samples/lightCells.h"
#include "hdDelegate/raster/passes/rasterBackground.h"
#include "hdDelegate/raster/tests/rasterFixture.h"
#include "hdDelegate/scene/tests/prims.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <cstring>
#include <map>

namespace {

using namespace patina;

struct Placed {
    GpuLight light;
    AreaShape shape;
    LightEstimate estimate;
};

Placed place(LightType type, const mat4& toWorld) {
    Light light;
    light.type = type;
    light.path = "/light";
    light.width = 0.3f;
    light.height = 0.2f;
    light.radius = 0.15f;
    light.length = 0.5f;
    Diagnostics diagnostics;
    const ResolvedLight is = resolveLight(light, toWorld, diagnostics);
    const LightPose pose = lightPose(light, is.kind, toWorld, nullptr);
    Placed out;
    out.light.setLight(light, is, pose);
    out.light.radiance = vec3(2.0f);
    out.shape = pose.shape;
    out.estimate = estimateOf(out.light, &out.shape, 1.0f);
    return out;
}

const LightType shapes[] = {LightType::Sphere, LightType::Rect, LightType::Disk,
                            LightType::Cylinder};

/// What a light of radiance 2 sends to a surface that faces its middle, by an even grid of samples.
double irradiance(const Placed& of, const vec3& point) {
    const vec3 towards = glm::normalize(of.shape.origin - point);
    const int n = 64;
    double sum = 0.0;
    for (int i = 0; i < n * n; ++i) {
        const vec2 u((float(i % n) + 0.5f) / n, (float(i / n) + 0.5f) / n);
        ShapeSample s;
        if (!sampleShape(of.shape, point, u, s) || !(s.pdf > 0.0f)) continue;
        const float c = glm::dot(glm::normalize(s.position - point), towards);
        sum += 2.0 * std::max(c, 0.0f) / s.pdf;
    }
    return sum / (n * n);
}

TEST(LightEstimate, isTheIrradianceFarAwayAndNearItNearBy) {
    const mat4 turned = glm::rotate(translate(1, 2, -1), 0.7f, glm::normalize(vec3(1, 2, 3)));
    for (const LightType type : shapes) {
        const Placed p = place(type, turned);
        // The brightest side: along the normal, across cylinders.
        const vec3 out = p.shape.flat ? p.shape.normal : glm::normalize(p.light.axis1);
        // At ten radii outlines are seen under a cosine of 0.995, and squared distances to parts of
        // a light are off by as much: 2 % in all. The side of a cylinder that is seen is nearer
        // than its middle, by pi / 4 of its radius in the mean, which its length is seen longer by.
        // At one radius from the surface no factor of the estimate is off by more than 3.
        const float far = 10.0f * p.estimate.radius, near = 2.0f * p.estimate.radius;
        const vec3 at = p.shape.origin + out * far, beside = p.shape.origin + out * near;
        const float nearer = type == LightType::Cylinder ? 0.25f * pi * 0.15f / far : 0.0f;
        EXPECT_NEAR(p.estimate.towards(at, 0.0f) / irradiance(p, at), 1.0, 0.02 + nearer)
            << int(type);
        const double ratio = p.estimate.towards(beside, 0.0f) / irradiance(p, beside);
        EXPECT_LT(ratio, 3.0) << int(type);
        EXPECT_GT(ratio, 1.0 / 3.0) << int(type);
    }
}

TEST(LightEstimate, goesWithTheConeAndIsNeverNothing) {
    Placed p = place(LightType::Sphere, mat4(1.0f));
    p.light.set(shLights::LIGHT_HAS_CONE);
    p.light.shapingAxis = vec3(0, 0, -1);
    p.light.coneStart = 0.3f;
    p.light.coneEnd = 0.6f;
    const LightEstimate e = estimateOf(p.light, &p.shape, 1.0f);
    const float inside = e.towards(vec3(0, 0, -100), 0.0f);
    EXPECT_FLOAT_EQ(inside, p.estimate.towards(vec3(0, 0, -100), 0.0f));
    const float outside = e.towards(vec3(0, 100, 0), 0.0f);
    EXPECT_GT(outside, 0.0f);
    EXPECT_LE(outside, 0.06f * inside);
    // A ball that the cone meets gets what its brightest place gets.
    EXPECT_FLOAT_EQ(e.towards(vec3(0, 100, -100), 80.0f),
                    e.towards(vec3(0, 0, -141.4213562f), 0.0f));
}

std::vector<LightEstimate> lightsAround(size_t number) {
    std::vector<LightEstimate> out;
    for (size_t i = 0; i < number; ++i) {
        LightEstimate e;
        const auto part = [&](double step) { return float(std::fmod(double(i) * step, 1.0)); };
        e.place = vec3(part(0.7548777), part(0.5698403), part(0.3247180)) * vec3(8, 1, 8);
        e.power = i % 7 == 3 ? 0.0f : 0.2f + 5.0f * part(0.618034);
        e.radius = 0.03f;
        e.least = 1e-3f;
        out.push_back(e);
    }
    return out;
}

float shareOf(uint32_t entry) {
    entry &= 0xffffff00u;
    float share;
    std::memcpy(&share, &entry, sizeof share);
    return share;
}

TEST(LightCells, everyLightCountsOnceInTheMean) {
    const auto lights = lightsAround(60);
    const int passes = 256;
    std::map<size_t, double> mean;
    size_t cells = 0;
    double most = 0.0;
    for (int pass = 0; pass < passes; ++pass) {
        const LightCells made(lights, 2, vec3(0.0f), vec3(8, 1, 8), 5, uint32_t(pass));
        cells = size_t(made.sides.x) * size_t(made.sides.y) * size_t(made.sides.z);
        ASSERT_EQ(made.lists.size(), cells * LightCells::listed);
        for (const uint32_t entry : made.lists) {
            mean[entry & 255u] += double(shareOf(entry));
            most = std::max(most, double(shareOf(entry)));
        }
    }
    EXPECT_GT(cells, size_t(LightCells::maxCells / 2));
    // No light is less probable than what all have alike leaves it: 58 lights, 8 of them dark.
    const double bound = 50.0 / (LightCells::listed * double(LightCells::even));
    EXPECT_LE(most, bound * 1.0001);
    // Chances are at least 1 / bound, so a mean over n independent lists has a variance of at most
    // bound / n; 5 standard deviations, beside the rounding of entries to 15 bits.
    const double n = double(cells) * passes;
    const double allowed = 5.0 * std::sqrt(bound / n) + 1.6e-5;
    for (size_t i = 0; i < lights.size(); ++i) {
        if (i < 2 || !(lights[i].power > 0.0f))
            EXPECT_EQ(mean[i], 0.0) << i;
        else
            EXPECT_NEAR(mean[i] / n, 1.0, allowed) << i;
    }
}

TEST(LightCells, listsHoldAllLightsThatTheyHaveRoomFor) {
    const auto lights = lightsAround(18); // 15 that shine
    const LightCells made(lights, 0, vec3(0.0f), vec3(8, 1, 8), 1, 9);
    for (size_t i = 0; i < made.lists.size(); ++i)
        EXPECT_EQ(shareOf(made.lists[i]), i % LightCells::listed < 15 ? 1.0f : 0.0f) << i;
}

TEST(LightCells, surviveBoundsThatAreNone) {
    const auto lights = lightsAround(40);
    for (const auto& [low, high] :
         {std::pair(vec3(1.0f), vec3(1.0f)), std::pair(vec3(INFINITY), vec3(-INFINITY)),
          std::pair(vec3(0.0f), vec3(1e30f, 0.0f, 0.0f))}) {
        const LightCells made(lights, 0, low, high, 1, 0);
        ASSERT_FALSE(made.lists.empty());
        for (const uint32_t entry : made.lists)
            EXPECT_TRUE(std::isfinite(shareOf(entry)));
        EXPECT_TRUE(std::isfinite(made.perUnit.x + made.low.x));
    }
}

TEST(RasterBackground, partsOfTheImageHoldWhatALightCovers) {
    const int width = 200, height = 100;
    const mat4 view = glm::lookAt(vec3(0, 1, 6), vec3(0.0f), vec3(0, 1, 0));
    const mat4 toClip = glm::perspective(0.9f, 2.0f, 0.5f, 40.0f) * view;
    for (const LightType type : shapes)
        for (int turn = 0; turn < 5; ++turn) {
            const Placed p = place(type, glm::rotate(translate(turn - 2, 0.3f * turn, -turn),
                                                     float(turn), glm::normalize(vec3(1, 2, 3))));
            const ShownLights shown = shownLight(p.light, toClip, width, height);
            EXPECT_TRUE(shown.alone());
            for (int i = 0; i < 400; ++i) {
                const vec2 u((i % 20 + 0.5f) / 20, (i / 20 + 0.5f) / 20);
                const vec3 q =
                    p.shape.origin + p.shape.axes * shLights::shapePlace(int(p.shape.kind), u);
                const vec4 clip = toClip * vec4(q, 1.0f);
                const float x = (clip.x / clip.w * 0.5f + 0.5f) * width;
                const float y = (clip.y / clip.w * 0.5f + 0.5f) * height;
                if (x < 0 || y < 0 || x >= width || y >= height) continue;
                EXPECT_GE(x, float(shown.left));
                EXPECT_LT(x, float(shown.left + shown.width));
                EXPECT_GE(y, float(shown.bottom));
                EXPECT_LT(y, float(shown.bottom + shown.height));
            }
            // Tight, too: a pixel and its rounding on each side of the box around the shape.
            EXPECT_LT(shown.width, width / 3);
        }
}

TEST(RasterBackground, lightsThatDepthDoesNotOrderAreTold) {
    const mat4 toClip = glm::perspective(0.9f, 1.0f, 0.5f, 40.0f) *
                        glm::lookAt(vec3(0, 0, 6), vec3(0.0f), vec3(0, 1, 0));
    const auto at = [&](float z) {
        return shownLight(place(LightType::Sphere, translate(0, 0, z)).light, toClip, 100, 100);
    };
    EXPECT_TRUE(at(0.0f).alone());
    EXPECT_EQ(at(7.0f).width, 0); // behind the camera
    EXPECT_TRUE(at(5.7f).near);   // before the near plane
    EXPECT_FALSE(at(5.7f).alone());
    EXPECT_TRUE(at(-50.0f).beyond);
    EXPECT_EQ(at(6.05f).width, 100); // around the camera: the whole image
}

} // namespace

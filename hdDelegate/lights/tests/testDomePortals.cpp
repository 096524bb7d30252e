// SPDX-License-Identifier: Apache-2.0
// Portals of domes: their map's density, and that the dome's light is the same with them.

#include "hdDelegate/lights/domePortals.h"
#include "hdDelegate/lights/tests/lightTools.h"

using namespace patina;

namespace {

mat4 place() {
    return glm::scale(at(0.4f, 1.2f, -2.0f) * turned(0.7, vec3(0.3f, 1.0f, 0.2f)),
                      vec3(2.0f, 0.5f, 1.0f));
}

/// A sky with a bright spot and a dark half.
float sky(const vec3& d) {
    return d.y < -0.3f ? 0.0f : 0.5f + d.x + 1.0f + 40.0f * std::pow(std::max(d.z, 0.0f), 50.0f);
}

/// Points that the portal lights: on its -z side.
vec3 pointBefore(Random& random) {
    const vec3 u = random.cube();
    return vec3(place() * vec4(4.0f * u.x - 2.0f, 4.0f * u.y - 2.0f, -0.2f - 4.0f * u.z, 1.0f));
}

} // namespace

TEST(DomePortal, densityIntegratesToOneOverTheWindow) {
    const DomePortal portal(place(), 1.0f, 1.0f, sky);
    ASSERT_TRUE(portal.valid());
    Random random(5);
    for (int k = 0; k < 4; ++k) {
        const vec3 point = pointBefore(random);
        const DomePortal::Window window = portal.window(point);
        ASSERT_GT(window.worth, 0.0);
        EXPECT_TRUE(agree(
            estimate(400000, [&] { return 4.0 * testPi * portal.pdf(window, random.direction()); }),
            1.0));
    }
}

TEST(DomePortal, samplesPassThroughTheRectangleWithTheirDensity) {
    const DomePortal portal(place(), 1.0f, 1.0f, sky);
    Random random(6);
    for (int k = 0; k < 4; ++k) {
        const vec3 point = pointBefore(random);
        const DomePortal::Window window = portal.window(point);
        const mat4 toPortal = glm::inverse(place());
        const vec3 p(toPortal * vec4(point, 1.0f));
        // 1 over the density has the solid angle of the rectangle as its mean, where the sky is.
        const Estimate e = estimate(20000, [&] {
            const vec3 d = portal.sample(window, vec2(random.cube()));
            const vec3 local = glm::mat3(toPortal) * d;
            const vec3 at = p - p.z / local.z * local;
            EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), 0.5f + 1e-3f);
            const float pdf = portal.pdf(window, d);
            return pdf > 0.0f ? 1.0 / pdf : 0.0;
        });
        const Estimate angle = estimate(400000, [&] {
            return portal.pdf(window, random.direction()) > 0.0f ? 4.0 * testPi : 0.0;
        });
        EXPECT_TRUE(agree(e, angle));
    }
}

TEST(DomePortal, seesNothingFromItsOtherSide) {
    const DomePortal portal(place(), 1.0f, 1.0f, sky);
    EXPECT_EQ(portal.window(vec3(place() * vec4(0.0f, 0.0f, 1.0f, 1.0f))).worth, 0.0);
    EXPECT_EQ(portal.window(vec3(place()[3])).worth, 0.0) << "in its plane";
    EXPECT_FALSE(DomePortal(mat4(0.0f), 1.0f, 1.0f, sky).valid());
    EXPECT_FALSE(DomePortal(place(), 0.0f, 1.0f, sky).valid());
    EXPECT_FALSE(DomePortal(place(), 1.0f, 1.0f, [](const vec3&) { return 0.0f; }).valid());
}

TEST(DomePortal, aDomeGivesTheSameIrradianceWithPortals) {
    auto dome = makeLight(LightType::Dome);
    dome->portals = {{"/portal", MotionTransform(dmat4(place())), 1.0f, 1.0f}};
    LightScene scene;
    const LightSet& set = scene.build(dome);
    const vec3 normal(0.0f, 0.0f, -1.0f);
    Random random(8);
    for (int k = 0; k < 3; ++k) {
        const vec3 point = pointBefore(random);
        const Estimate e = estimate(200000, [&] {
            LightSample s;
            if (!set.sample(point, normal, false, random.cube(), 0.0f, s)) return 0.0;
            EXPECT_NEAR(pdfTowards(set, s.direction, normal, false, point) / s.pdf, 1.0f, 1e-3f);
            return double(s.radiance.x) * std::max(0.0f, glm::dot(s.direction, normal)) / s.pdf;
        });
        EXPECT_TRUE(agree(e, testPi * dome->intensity));
    }
}

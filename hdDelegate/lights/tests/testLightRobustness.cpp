// SPDX-License-Identifier: Apache-2.0
// Lights that are broken: no NaN, no crash, a warning that names the light where it is a mistake.

#include "hdDelegate/lights/tests/lightTools.h"

#include <limits>

using namespace patina;

namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

/// Samples and shoots at the lights and expects finite numbers throughout.
void exercise(const LightSet& set) {
    Random random(41);
    for (int i = 0; i < 500; ++i) {
        const vec3 point = 4.0f * random.cube() - 2.0f, normal = random.direction();
        LightSample s;
        if (set.sample(point, normal, i % 2 == 0, random.cube(), 0.0f, s)) {
            EXPECT_TRUE(std::isfinite(s.pdf) && s.pdf > 0.0f);
            EXPECT_TRUE(std::isfinite(s.radiance.x + s.radiance.y + s.radiance.z));
            EXPECT_NEAR(glm::length(s.direction), 1.0f, 1e-4f);
            EXPECT_FALSE(std::isnan(s.distance));
        }
        LightHit hits[4];
        const int found = set.intersect(point, normal, 0.0f, INFINITY, 0.0f, hits, 4);
        for (int k = 0; k < found; ++k) {
            EXPECT_TRUE(std::isfinite(hits[k].radiance.x));
            EXPECT_TRUE(std::isfinite(set.pdf(hits[k].light, point, normal, false, 0.0f, hits[k])));
        }
        EXPECT_TRUE(std::isfinite(set.environment(normal, 0.0f).x));
    }
}

} // namespace

TEST(Robustness, brokenLightsAreOffAndNamed) {
    struct Case {
        const char* what;
        std::function<void(Light&)> breakIt;
    };
    const Case cases[] = {
        {"no radius", [](Light& l) { l.radius = l.width = l.length = 0.0f; }},
        {"NaN radius", [](Light& l) { l.radius = l.width = notANumber; }},
        {"NaN colour", [](Light& l) { l.color.y = notANumber; }},
        {"infinite exposure", [](Light& l) { l.exposure = 1e9f; }},
        {"NaN transform", [](Light& l) { l.transform.values[0][3].x = notANumber; }},
        {"flattened", [](Light& l) { l.transform.values[0] = mat4(0.0f); }},
    };
    for (const LightType type : areaTypes)
        for (const Case& c : cases) {
            auto light = makeLight(type);
            c.breakIt(*light);
            LightScene scene;
            const LightSet& set = scene.build(light);
            EXPECT_TRUE(set.empty()) << c.what << ", type " << int(type);
            ASSERT_GE(scene.diagnostics.count(), 1) << c.what << ", type " << int(type);
            EXPECT_EQ(scene.diagnostics.all()[0].prim, "/light");
            exercise(set);
        }
}

TEST(Robustness, lightThatIsTakenAwayIsSampledLikeLightThatIsGiven) {
    for (const LightType type : {LightType::Sphere, LightType::Rect, LightType::Disk,
                                 LightType::Cylinder, LightType::Dome, LightType::Distant}) {
        LightScene given, taken;
        auto light = makeLight(type), minus = makeLight(type);
        minus->intensity = -light->intensity;
        given.build(light);
        taken.build(minus);
        EXPECT_EQ(taken.diagnostics.count(), 0);
        Random random(7);
        for (int i = 0; i < 100; ++i) {
            const vec3 u = random.cube(), point(0.1f, 0.2f, -3.0f), normal(0.0f, 0.0f, 1.0f);
            LightSample a, b;
            const bool found = given.set->sample(point, normal, true, u, 0.0f, a);
            ASSERT_EQ(taken.set->sample(point, normal, true, u, 0.0f, b), found);
            if (!found) continue;
            EXPECT_EQ(a.direction, b.direction);
            EXPECT_EQ(a.pdf, b.pdf);
            EXPECT_EQ(a.radiance, -b.radiance) << int(type);
        }
    }
}

TEST(Robustness, lightsThatAreMerelyOffDoNotWarn) {
    auto off = makeLight(LightType::Sphere);
    off->intensity = 0.0f;
    auto hidden = makeLight(LightType::Sphere);
    hidden->visible = false;
    LightScene scene;
    scene.input.lights = {{off, mat4(1.0f)}, {hidden, mat4(1.0f)}, {nullptr, mat4(1.0f)}};
    EXPECT_TRUE(scene.build().empty());
    EXPECT_EQ(scene.diagnostics.count(), 0);
    EXPECT_EQ(scene.set->lightCount(), 3);
}

TEST(Robustness, extremeShapes) {
    LightScene scene;
    for (const LightType type : areaTypes)
        for (const vec3 scale : {vec3(1e-3f), vec3(1e3f), vec3(1e-3f, 1.0f, 1e3f),
                                 vec3(-1.0f, 1.0f, 1.0f), vec3(1.0f, 1.0f, 1e-4f)})
            scene.add(makeLight(type, glm::scale(mat4(1.0f), scale)));
    exercise(scene.build());
    EXPECT_EQ(scene.diagnostics.count(), 0);
}

TEST(Robustness, pointsOnAndInTheLight) {
    for (const LightType type : areaTypes)
        for (const bool standIn : {false, true}) {
            auto light = makeLight(type);
            light->treatAsPoint = light->treatAsLine = standIn;
            LightScene scene;
            const LightSet& set = scene.build(light);
            for (const vec3 point : {vec3(0.0f), vec3(0.5f, 0.0f, 0.0f), vec3(0.0f, 0.5f, 0.0f),
                                     vec3(0.0f, 0.0f, -1e-7f), vec3(0.2f, 0.1f, 0.0f)}) {
                Random random(42);
                for (int i = 0; i < 200; ++i) {
                    LightSample s;
                    if (set.sample(point, vec3(0.0f, 0.0f, 1.0f), false, random.cube(), 0.0f, s)) {
                        EXPECT_TRUE(std::isfinite(s.pdf) && std::isfinite(s.radiance.x));
                    }
                }
            }
        }
}

TEST(Robustness, brokenTrianglesAndMissingProfile) {
    LightScene scene;
    std::vector<LightTriangle> triangles(3);
    triangles[0].vertices[1] = vec3(notANumber);
    triangles[2].vertices[1] = vec3(1.0f, 0.0f, 0.0f);
    triangles[2].vertices[2] = vec3(0.0f, 1.0f, 0.0f);
    triangles[2].luminance = notANumber;
    scene.setTriangles(triangles);
    EXPECT_TRUE(scene.build().empty());
    scene.input.glowing[0].shared = true;
    EXPECT_TRUE(scene.build().empty());
    auto light = makeLight(LightType::Sphere);
    light->iesFile = "/missing.ies";
    scene.setTriangles({});
    const LightSet& set = scene.build(light);
    EXPECT_FALSE(set.empty());
    EXPECT_EQ(scene.diagnostics.all()[0].input, "inputs:shaping:ies:file");
    exercise(set);
}

TEST(Robustness, brokenPixels) {
    LightScene scene(loaderOf(image(4, 2, [](int x, int y) {
        if (x != 1) return vec3(1.0f);
        return y ? vec3(std::numeric_limits<float>::infinity(), -1.0f, 2.0f) : vec3(notANumber);
    })));
    for (const LightType type : {LightType::Dome, LightType::Rect}) {
        auto light = makeLight(type);
        light->textureFile = "broken.exr";
        const LightSet& set = scene.build(light);
        EXPECT_FALSE(set.empty());
        exercise(set);
    }
}

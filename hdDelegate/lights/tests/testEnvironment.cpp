// SPDX-License-Identifier: Apache-2.0
// Domes with images: orientation, formats, importance sampling.

#include "hdDelegate/lights/tests/lightTools.h"

using namespace patina;

namespace {

/// The directions' own colours: what an image of this format shows when the world has colour
/// 0.5 + 0.5 d in direction d.
vec3 worldColor(const vec3& d) {
    return 0.5f + 0.5f * d;
}

Light latlong(const std::string& file) {
    Light dome = *makeDome(file);
    dome.textureFormat = "latlong";
    return dome;
}

/// A map shows those colours wherever `seen` says so.
void expectWorld(const EnvironmentMap& map, float tolerance, uint32_t seed,
                 const std::function<bool(const vec3&)>& seen) {
    Random random(seed);
    for (int i = 0; i < 2000; ++i) {
        const vec3 d = random.direction();
        if (seen(d)) {
            EXPECT_LT(glm::length(map.radiance(d) - worldColor(d)), tolerance);
        }
    }
}

} // namespace

TEST(Environment, latlongStandsAsOpenExrSays) {
    const auto pixels = image(64, 32, [](int x, int y) {
        return worldColor(latlongDirection((x + 0.5f) / 64.0f, (y + 0.5f) / 32.0f));
    });
    const EnvironmentMap map(pixels, EnvironmentFormat::Latlong);
    expectWorld(map, 0.03f, 31, [](const vec3& d) { return std::abs(d.y) < 0.95f; });
    // Left and right edge meet at longitude pi, -z; a quarter from the left is +x.
    const auto quarters = image(8, 4, [](int x, int) { return vec3(float(x)); });
    const EnvironmentMap steps(quarters, EnvironmentFormat::Latlong);
    EXPECT_NEAR(steps.radiance(vec3(1.0f, 0.0f, 0.0f)).x, 1.5f, 1e-4f);
    EXPECT_NEAR(steps.radiance(vec3(0.0f, 0.0f, 1.0f)).x, 3.5f, 1e-4f);
    EXPECT_NEAR(steps.radiance(vec3(-1.0f, 0.0f, 0.0f)).x, 5.5f, 1e-4f);
    EXPECT_NEAR(steps.radiance(vec3(0.0f, 0.0f, -1.0f)).x, 3.5f, 1e-4f); // mean of 0 and 7
}

TEST(Environment, aPlaceSaysWhatItsDirectionSays) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(2, 1), glm::ivec2(64, 32)})
        for (const EnvironmentFormat format :
             {EnvironmentFormat::Latlong, EnvironmentFormat::MirroredBall,
              EnvironmentFormat::Angular, EnvironmentFormat::CubeMapVerticalCross}) {
            const EnvironmentMap map(
                image(size.x, size.y, [](int x, int y) { return vec3(1.0f + x, 2.0f + y, 3.0f); }),
                format);
            Random random(37);
            for (int i = 0; i < 200; ++i) {
                const vec3 d = random.direction(), normal = random.direction();
                const EnvironmentMap::Place place = map.place(d);
                EXPECT_EQ(map.radiance(place), map.radiance(d));
                EXPECT_EQ(map.pdf(place, normal, i % 2 == 0), map.pdf(d, normal, i % 2 == 0));
                // A sample in two steps is one in one step.
                const vec2 u(random.cube());
                float inSteps, atOnce;
                const auto begun = map.begin(u, normal, i % 2 == 0);
                EXPECT_EQ(map.sample(begun, inSteps), map.sample(u, atOnce, normal, i % 2 == 0));
                EXPECT_EQ(inSteps, atOnce);
            }
            map.place(vec3(std::nanf(""))); // broken geometry: asks for nothing out of bounds
        }
}

TEST(Environment, angularAndMirroredBall) {
    for (const EnvironmentFormat format :
         {EnvironmentFormat::Angular, EnvironmentFormat::MirroredBall}) {
        const int size = 256;
        const auto pixels = image(size, size, [&](int x, int y) {
            const vec2 p = 1.0f - 2.0f * (vec2(x, y) + 0.5f) / float(size);
            const float r = std::min(glm::length(p), 1.0f);
            const vec2 side = r > 0.0f ? glm::normalize(p) : vec2(0.0f);
            if (format == EnvironmentFormat::Angular)
                return worldColor(
                    vec3(std::sin(float(testPi) * r) * side, std::cos(float(testPi) * r)));
            // Reflection of the view along -z at the ball's normal.
            const vec3 n(r * side, std::sqrt(1.0f - r * r)), view(0.0f, 0.0f, -1.0f);
            return worldColor(view - 2.0f * glm::dot(view, n) * n);
        });
        const EnvironmentMap map(pixels, format);
        expectWorld(map, 0.03f, 32, [](const vec3& d) { return d.z > -0.9f; });
    }
}

TEST(Environment, verticalCross) {
    const int size = 32;
    const auto pixels = image(3 * size, 4 * size, [&](int x, int y) {
        const int column = x / size, row = y / size;
        const float s = 2.0f * (x % size + 0.5f) / size - 1.0f;
        const float t = 2.0f * (y % size + 0.5f) / size - 1.0f;
        vec3 d(0.0f);
        if (column == 1) {
            const vec3 faces[4] = {vec3(-s, 1.0f, t), vec3(-s, -t, 1.0f), vec3(-s, -1.0f, -t),
                                   vec3(-s, t, -1.0f)};
            d = faces[row];
        } else if (row == 1) {
            d = column == 0 ? vec3(1.0f, -t, s) : vec3(-1.0f, -t, -s);
        } else {
            return vec3(100.0f); // never seen
        }
        return worldColor(glm::normalize(d));
    });
    const EnvironmentMap map(pixels, EnvironmentFormat::Automatic);
    expectWorld(map, 0.06f, 33, [](const vec3&) { return true; });
}

TEST(Environment, densityIntegratesToOneAndCoversTheImage) {
    Random noise(34);
    for (const EnvironmentFormat format :
         {EnvironmentFormat::Latlong, EnvironmentFormat::Angular}) {
        const int height = format == EnvironmentFormat::Latlong ? 16 : 32;
        const auto pixels = image(32, height, [&](int, int) {
            return noise() < 0.7f ? vec3(0.0f) : vec3(10.0f * noise());
        });
        const EnvironmentMap map(pixels, format);
        Random random(35);
        const Estimate total =
            estimate(200000, [&] { return 4.0 * testPi * map.pdf(random.direction()); });
        EXPECT_TRUE(agree(total, 1.0));
        int different = 0; // on a cell's edge rounding may land in the neighbour
        for (int i = 0; i < 20000; ++i) {
            float pdf;
            const vec3 d = map.sample(random.square(), pdf);
            different += std::abs(map.pdf(d) / pdf - 1.0f) > 1e-3f;
            EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
            const vec3 e = random.direction();
            if (format == EnvironmentFormat::Latlong && map.radiance(e).x > 1e-4f) {
                EXPECT_GT(map.pdf(e), 0.0f);
            }
        }
        EXPECT_LT(different, 20);
    }
}

TEST(Environment, oneBrightPixel) {
    // A sun of one pixel in a dim sky: importance sampling finds it, and its irradiance is exact.
    const int width = 256, height = 128;
    const float bright = 20000.0f;
    const auto pixels = image(
        width, height, [&](int x, int y) { return vec3(x == 100 && y == 40 ? bright : 0.1f); });
    LightScene scene(loaderOf(pixels));
    const auto light = makeDome("sun");
    const LightSet& set = scene.build(light);
    double exact = 0.0; // over the cells that the bright pixel's bilinear tent covers, finely
    const int fine = 32;
    for (int y = 38 * fine; y < 43 * fine; ++y)
        for (int x = 98 * fine; x < 103 * fine; ++x) {
            const double theta = testPi * (y + 0.5) / (height * fine);
            const double tx = 1.0 - std::abs((x + 0.5) / fine - 100.5);
            const double ty = 1.0 - std::abs((y + 0.5) / fine - 40.5);
            if (tx > 0.0 && ty > 0.0)
                exact += (bright - 0.1) * tx * ty * std::sin(theta) * std::cos(theta);
        }
    exact *= testPi / (height * fine) * 2.0 * testPi / (width * fine);
    exact += 0.1 * testPi;
    const vec3 up(0.0f, 1.0f, 0.0f);
    const Estimate e = irradiance(set, vec3(0.0f), up, 50000, 36);
    EXPECT_TRUE(agree(e, exact, 2e-3));
    EXPECT_LT(e.deviation() / e.mean(), 1.5); // uniform sampling: about 70
    LightSample s;
    ASSERT_TRUE(set.sample(vec3(0.0f), up, false, vec3(0.3f, 0.7f, 0.5f), 0.0f, s));
    EXPECT_NEAR(pdfTowards(set, s.direction, up) / s.pdf, 1.0f, 1e-3f);
    EXPECT_LT(glm::length(set.environment(0, set.place(0, s.direction, 0.0f), 0.0f) - s.radiance),
              1e-3f * glm::length(s.radiance) + 1e-4f);
}

TEST(Environment, turnsWithItsTransform) {
    const auto pixels =
        image(8, 4, [](int x, int) { return vec3(x == 3 || x == 4 ? 1.0f : 0.0f); });
    LightScene scene(loaderOf(pixels));
    // Lit around +z in its own frame; turned a quarter about y it is lit around +x. Scale is
    // ignored.
    const auto light =
        makeDome("front", glm::scale(turned(testPi / 2.0, vec3(0.0f, 1.0f, 0.0f)), vec3(3.0f)));
    const LightSet& set = scene.build(light);
    EXPECT_NEAR(set.environment(vec3(1.0f, 0.0f, 0.0f), 0.0f).x, 1.0f, 1e-4f);
    EXPECT_NEAR(set.environment(vec3(-1.0f, 0.0f, 0.0f), 0.0f).x, 0.0f, 1e-4f);
    EXPECT_NEAR(set.environment(vec3(0.0f, 0.0f, 1.0f), 0.0f).x, 0.0f, 1e-4f);
}

TEST(Environment, aTurnedDomeIsSampledByTheNormalsOfTheWorld) {
    const auto pixels =
        image(64, 32, [](int x, int y) { return vec3(0.1f + (x * 7 + y * 3) % 11); });
    LightScene scene(loaderOf(pixels));
    const auto light = makeDome("turned", turned(1.1, vec3(1.0f, 2.0f, 3.0f)));
    const LightSet& set = scene.build(light);
    const vec3 point(0.0f);
    Random random(37);
    int different = 0; // on a cell's edge rounding may land in the neighbour
    for (int k = 0; k < 5; ++k) {
        const vec3 normal = random.direction();
        EXPECT_TRUE(agree(irradiance(set, point, normal, 50000, 38),
                          irradianceByRays(set, point, normal, 50000, 39)));
        for (int i = 0; i < 1000; ++i) {
            LightSample s;
            ASSERT_TRUE(set.sample(point, normal, i % 2 == 0, random.cube(), 0.0f, s));
            const float pdf = pdfTowards(set, s.direction, normal, i % 2 == 0);
            different += std::abs(pdf / s.pdf - 1.0f) > 1e-3f;
        }
    }
    EXPECT_LT(different, 10);
}

TEST(Environment, missingImageIsMagentaAndBlackOneIsNoLight) {
    LightScene missing;
    const auto light = makeDome("missing.hdr");
    EXPECT_EQ(missing.build(light).environment(vec3(0.0f, 1.0f, 0.0f), 0.0f),
              vec3(1.0f, 0.0f, 1.0f));
    const auto black = image(4, 2, [](int, int) { return vec3(0.0f); });
    LightScene dark(loaderOf(black));
    EXPECT_TRUE(dark.build(light).empty());
}

TEST(Environment, sidesWithoutACommonFactorAndTheBrightestTexels) {
    // Primes: no cell's edges are those of texels. A sun of one pixel has to be found all the same.
    for (const float bright : {1e6f, 3e38f}) {
        const auto pixels = image(4099, 2053, [&](int x, int y) {
            return vec3(x == 1000 && y == 700 ? bright : bright > 1e30f ? bright : 0.1f);
        });
        LightImages images(loaderOf(pixels));
        const auto map = images.environment(latlong("sun"));
        EXPECT_TRUE(std::isfinite(map->mean().x) && map->mean().x > 0.0f);
        Random random(51);
        int found = 0;
        for (int i = 0; i < 1000; ++i) {
            float pdf = 0.0f;
            const vec3 d = map->sample(random.square(), pdf);
            EXPECT_TRUE(pdf > 0.0f && std::isfinite(pdf));
            found += map->radiance(d).x > 1e3f;
        }
        EXPECT_GT(found, 100);
    }
}

TEST(Environment, imagesThatNoLightHoldsAreForgotten) {
    int loaded = 0;
    const auto pixels = image(4, 2, [](int, int) { return vec3(1.0f); });
    LightImages images(loaderOf(pixels, &loaded));
    const auto load = [&] { return images.environment(latlong("a")); };
    auto held = load();
    images.forgetUnused();
    EXPECT_EQ(load(), held);
    EXPECT_EQ(loaded, 1);
    held = nullptr;
    images.forgetUnused();
    load();
    EXPECT_EQ(loaded, 2);
}

TEST(Environment, imagesAreKeptBetweenBuilds) {
    int loaded = 0;
    const auto pixels = image(4, 2, [](int, int) { return vec3(1.0f); });
    LightScene scene(loaderOf(pixels, &loaded));
    const auto light = makeDome("a.hdr");
    scene.build(light);
    scene.build(light);
    EXPECT_EQ(loaded, 1);
}

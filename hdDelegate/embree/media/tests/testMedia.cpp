// SPDX-License-Identifier: Apache-2.0
// Media inside objects against closed forms and a walk of its own. Statistical tests compare means
// over pixels at five standard errors (significance 6e-7 per channel); seeds are fixed.

#include "hdDelegate/embree/media/tests/mediaScene.h"

#include "shaders/oracle.h"

using namespace patina;
using namespace patina::test;

namespace {

constexpr float wide = 2000.0f; ///< edge of slabs that stand for infinite ones

void expectRelativeMean(const MediaScene::Image& image, const vec3& expected, float slack = 1e-4f) {
    ASSERT_TRUE(image.finite);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.mean[c], expected[c], 5.0f * image.error[c] + slack * expected[c] + 1e-6f)
            << "channel " << c << ", standard error " << image.error[c];
}

/// A medium between z = -thickness and z = 0, seen from above.
MediaScene slab(const std::vector<NetworkNode>& volume, float thickness) {
    MediaScene s;
    s.material("/m", volume, "volume");
    s.cube("/slab", vec3(0, 0, -0.5f * thickness), vec3(wide, wide, thickness), "/m");
    s.camera(vec3(0, 0, 5), 1.0f);
    return s;
}

/// Escape weights of light that walks through a slab, met along the normal: the albedo to the power
/// of the number of collisions, by counting.
vec3 walkedSlab(float depth, const vec3& albedo, float g, int paths) {
    uint64_t state = 42;
    const auto next = [&] {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return double(state >> 11) * 0x1p-53;
    };
    double sum[3] = {};
    for (int i = 0; i < paths; ++i) {
        double z = 0.0, mu = 1.0, weight[3] = {1, 1, 1};
        while (true) {
            z += mu * -std::log(1.0 - next());
            if (z < 0.0 || z > depth) break;
            const double u = 2.0 * next() - 1.0, q = (1 - g * g) / (1 + g * u);
            const double c = g == 0.0f ? u : (1 + g * g - q * q) / (2 * g);
            const double phi = 2.0 * M_PI * next();
            mu = mu * c + std::sqrt(std::max(0.0, (1 - mu * mu) * (1 - c * c))) * std::cos(phi);
            for (int k = 0; k < 3; ++k)
                weight[k] *= albedo[k];
        }
        for (int k = 0; k < 3; ++k)
            sum[k] += weight[k];
    }
    return vec3(sum[0], sum[1], sum[2]) / float(paths);
}

} // namespace

TEST(Media, AbsorptionFollowsBeerAndLambert) {
    const vec3 absorption(0.1f, 1.0f, 3.0f);
    MediaScene s = slab(volumeNodes(absorption, vec3(0)), 1.5f);
    s.dome(2.0f);
    expectRelativeMean(s.render(4, 1), 2.0f * glm::exp(-1.5f * absorption));
}

TEST(Media, SingleScatteringFollowsItsIntegral) {
    const vec3 absorption(0.5f, 0.0f, 1.0f), scattering(0.5f, 2.0f, 3.0f),
        total = absorption + scattering;
    const float thickness = 0.7f, cosine = 0.8f;
    for (float g : {-0.6f, 0.0f, 0.8f}) {
        MediaScene s = slab(volumeNodes(absorption, scattering, g), thickness);
        s.distant(vec3(3.0f), vec3(0.6f, 0.0f, -cosine));
        s.settings.maxScatterings = 1;
        const auto phase = sh64::phaseHenyeyGreensteinSetup(g);
        const float p = float(
            sh64::phaseHenyeyGreensteinEval(phase, sh64::vec3(0, 0, 1), sh64::vec3(-0.6, 0, 0.8))
                .pdf);
        const float way = 1.0f + 1.0f / cosine;
        const vec3 expected = 3.0f * p * scattering *
                              (vec3(1.0f) - glm::exp(-way * thickness * total)) / (way * total);
        expectRelativeMean(s.render(64, 64), expected);
    }
}

TEST(Media, MultipleScatteringMatchesACountedWalk) {
    const vec3 albedo(1.0f, 0.9f, 0.5f);
    const int paths = 1 << 18;
    for (float g : {0.0f, 0.7f}) {
        const float depth = 4.0f;
        MediaScene s = slab(volumeNodes(depth * (vec3(1.0f) - albedo), depth * albedo, g), 1.0f);
        s.dome(1.0f);
        // The walk's own error: at most 0.5 / sqrt(paths) per channel.
        expectRelativeMean(s.render(64, 64), walkedSlab(depth, albedo, g, paths), 5e-3f);
    }
}

TEST(Media, WhiteMediaLoseNothing) {
    MediaScene s = ball(volumeNodes(vec3(0), vec3(1, 4, 16), 0.5f), "volume");
    s.whiteRoom(1.0f);
    expectRelativeMean(s.render(32, 64), vec3(1.0f));
}

TEST(Media, GlassAroundAWhiteMediumLosesNothing) {
    MediaScene s = ball(glassNodes(1.5f, 0.0f, vec3(0), vec3(0.5f, 1, 4)));
    s.settings.maxDepth = 1000;
    s.whiteRoom(1.0f);
    expectRelativeMean(s.render(32, 64), vec3(1.0f), 2e-3f);
}

TEST(Media, SameMaterialAgainIsTheSameAndAnotherReplacesIt) {
    const vec3 outer(1.0f, 0.5f, 0.2f), inner(3.0f, 0.0f, 1.0f);
    for (bool same : {false, true}) {
        MediaScene s = slab(volumeNodes(outer, vec3(0)), 2.0f);
        s.material("/n", volumeNodes(inner, vec3(0)), "volume");
        s.cube("/inner", vec3(0, 0, -1.0f), vec3(wide / 2, wide / 2, 0.5f), same ? "/m" : "/n");
        s.dome(1.0f);
        expectRelativeMean(s.render(4, 1), glm::exp(-1.5f * outer - 0.5f * (same ? outer : inner)));
    }
}

TEST(Media, ObjectsThatOverlapShowTheOneEnteredLast) {
    const vec3 first(1.0f, 0.5f, 0.2f), second(3.0f, 0.0f, 1.0f);
    MediaScene s = slab(volumeNodes(first, vec3(0)), 2.0f);
    s.material("/n", volumeNodes(second, vec3(0)), "volume");
    // From z = -1 to z = -3: inside the slab for 1, alone for 1.
    s.cube("/other", vec3(0, 0, -2.0f), vec3(wide / 2, wide / 2, 2.0f), "/n");
    s.dome(1.0f);
    expectRelativeMean(s.render(4, 1), glm::exp(-first - 2.0f * second));
}

TEST(Media, TheCameraMayStandInside) {
    const vec3 absorption(0.1f, 0.2f, 0.4f);
    MediaScene s;
    s.material("/m", volumeNodes(absorption, vec3(0)), "volume");
    s.material("/n", volumeNodes(vec3(1.0f), vec3(0)), "volume");
    s.cube("/room", vec3(0), vec3(20, 20, 20), "/m");
    s.cube("/box", vec3(0), vec3(2, 2, 2), "/n");
    s.dome(1.0f);
    for (const auto& [z, inBox, inRoom] :
         {std::tuple(0.0f, 1.0f, 9.0f), {5.0f, 2.0f, 13.0f}, {50.0f, 2.0f, 18.0f}}) {
        s.camera(vec3(0, 0, z), 1.0f);
        expectRelativeMean(s.render(4, 1), glm::exp(vec3(-inBox) - inRoom * absorption));
    }
}

TEST(Media, AnOpenSheetFillsNothing) {
    MediaScene s;
    s.material("/m", volumeNodes(vec3(1.0f), vec3(0)), "volume");
    s.plane("/ceiling", vec3(0, 0, 1), 100.0f, "/m");
    s.dome(1.0f);
    s.camera(vec3(0, 0, 0), 1.0f);
    expectRelativeMean(s.render(4, 1), vec3(1.0f));
}

TEST(Media, EmissionIsAbsorbedOnItsWay) {
    const vec3 absorption(0.0f, 1.0f, 4.0f);
    auto nodes = volumeNodes(absorption, vec3(0));
    nodes[0].connections["edf"] = {"/m/edf", ""};
    nodes.push_back(makeNode("edf", "ND_uniform_edf", {{"color", grey(2)}}));
    MediaScene s = slab(nodes, 1.5f);
    expectRelativeMean(s.render(4, 1),
                       {3.0f, 2.0f * (1.0f - std::exp(-1.5f)), 0.5f * (1.0f - std::exp(-6.0f))});
}

TEST(Media, PartsKeepTheirPhaseFunctions) {
    // Half scatters on, half back: as bright from both sides as the mean of both alone.
    const auto lit = [](std::vector<NetworkNode> nodes) {
        MediaScene s = slab(nodes, 0.1f);
        s.settings.maxScatterings = 1;
        s.distant(vec3(1.0f), vec3(0.6f, 0.0f, -0.8f));
        return s.render(32, 64);
    };
    const auto nodes = [](float a, float b) {
        auto n = volumeNodes(vec3(0), vec3(0.5f), a);
        n[0].connections["vdf"] = {"/m/sum", ""};
        n.push_back(makeNode("second", "ND_anisotropic_vdf",
                             {{"scattering", vec(vec3(0.5f))}, {"anisotropy", number(b)}}));
        n.push_back(
            makeNode("sum", "ND_add_vdf", {}, {{"in1", {"vdf", ""}}, {"in2", {"second", ""}}}));
        return n;
    };
    const auto on = lit(nodes(0.8f, 0.8f)), back = lit(nodes(-0.8f, -0.8f)),
               both = lit(nodes(0.8f, -0.8f));
    EXPECT_GT(back.mean.x, 10.0f * on.mean.x);
    const float expected = 0.5f * (on.mean.x + back.mean.x);
    EXPECT_NEAR(both.mean.x, expected, 5.0f * (both.error.x + back.error.x) + 1e-5f);
}

TEST(Media, ExtremesStayFinite) {
    const float inf = INFINITY, nan = NAN;
    for (float coefficient : {0.0f, 1e-30f, 1e-6f, 1e6f, 1e30f, inf, -1.0f, nan})
        for (float g : {-1.0f, 0.0f, 1.0f, nan}) {
            SCOPED_TRACE(std::to_string(coefficient) + " " + std::to_string(g));
            MediaScene s =
                ball(volumeNodes(vec3(coefficient, 0, 1), vec3(1, coefficient, 0), g), "volume");
            s.settings.maxScatterings = 32;
            s.dome(1.0f);
            s.camera(vec3(0.1f, 0, 0.2f), 1.0f);
            expectSane(s.render(8, 8));
        }
}

TEST(Media, ThreadsChangeNothing) {
    expectThreadsChangeNothing(32, 16, [](MediaScene& s) {
        s.material("/m", glassNodes(1.33f, 0.2f, vec3(0.1f), vec3(1, 2, 3)));
        s.sphere("/ball", vec3(0), 1.0f, "/m");
        s.whiteRoom(3.0f);
    });
}

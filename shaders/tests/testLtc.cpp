// SPDX-License-Identifier: Apache-2.0
// Linearly transformed cosines against brute force: shares of polygons are exact for the cosine,
// and within a stated bound of what facets reflect. Everything here is deterministic.

#include <random>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shaders/areaLights.h"
#include "shaders/tests/lobeCase.h"

using namespace patina;
using sh::vec3;

namespace {

constexpr int gridSide = 160; // cells along a side of a rectangle, and of the facets' numbers

/// A rectangle as seen from the point that is lit.
struct Rect {
    vec3 centre, u, v; ///< half axes

    float share(const vec3& wo, const sh::vec4& map) const {
        vec3 corners[sh::LTC_CORNERS];
        const float signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        for (int i = 0; i < 4; ++i)
            corners[i] = sh::ltcTurned(centre + u * signs[i][0] + v * signs[i][1], wo);
        return sh::ltcShare(corners, 4, map);
    }

    /// The integral of a density by solid angle.
    template <typename Density> double brute(const Density& density) const {
        const vec3 normal = glm::cross(u, v);
        const double area = 4.0 * glm::length(normal) / (double(gridSide) * gridSide);
        double sum = 0.0;
        for (int i = 0; i < gridSide * gridSide; ++i) {
            const float a = 2.0f * (float(i % gridSide) + 0.5f) / gridSide - 1.0f;
            const float b = 2.0f * (float(i / gridSide) + 0.5f) / gridSide - 1.0f;
            const vec3 p = centre + u * a + v * b;
            const float d2 = glm::dot(p, p);
            const vec3 wi = p / std::sqrt(d2);
            if (wi.z <= 0.0f) continue;
            sum += density(wi) * std::abs(glm::dot(glm::normalize(normal), wi)) / double(d2) * area;
        }
        return sum;
    }
};

std::vector<Rect> rects(int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> x(-1.0f, 1.0f);
    std::vector<Rect> made;
    while (int(made.size()) < count) {
        const vec3 n = glm::normalize(vec3(x(random), x(random), x(random)));
        const vec3 centre = vec3(2.0f * x(random), 2.0f * x(random), 1.0f + 1.2f * x(random));
        const vec3 u = glm::normalize(glm::cross(n, vec3(0.3f, 0.9f, 0.1f)));
        const vec3 v = glm::cross(n, u);
        // Not nearly edge on, and not through the point.
        if (std::abs(glm::dot(n, centre)) > 0.4f)
            made.push_back({centre, u * (0.6f + 0.4f * x(random)), v * (0.6f + 0.4f * x(random))});
    }
    return made;
}

/// Isotropic GGX facets that reflect all, as a density: the lobe times cosine over its albedo.
struct MicrofacetLobe {
    vec3 wo;
    float alpha;
    double albedo = 0.0;

    MicrofacetLobe(float mu, float a) : wo(std::sqrt(1.0f - mu * mu), 0.0f, mu), alpha(a) {
        for (int i = 0; i < gridSide * gridSide; ++i) {
            const sh::vec2 u((float(i % gridSide) + 0.5f) / gridSide,
                             (float(i / gridSide) + 0.5f) / gridSide);
            const vec3 m = sh::ggxSampleVisible(wo, sh::vec2(alpha), u);
            const vec3 wi = 2.0f * glm::dot(m, wo) * m - wo;
            if (wi.z <= 0.0f) continue;
            const float lo = sh::ggxLength(wo, sh::vec2(alpha));
            albedo += double(wi.z * (wo.z + lo) / masking(wi));
        }
        albedo /= double(gridSide) * gridSide;
    }

    double operator()(const vec3& wi) const {
        const vec3 m = glm::normalize(wo + wi);
        return double(sh::ggxD(m, sh::vec2(alpha)) * wi.z / (2.0f * masking(wi))) / albedo;
    }

    float masking(const vec3& wi) const {
        return sh::ggxLength(wo, sh::vec2(alpha)) * wi.z +
               sh::ggxLength(wi, sh::vec2(alpha)) * wo.z;
    }
};

} // namespace

TEST(Ltc, TheShareOfTheCosineIsExact) {
    const sh::vec4 same(1.0f, 0.0f, 1.0f, 0.0f);
    int cut = 0;
    for (const Rect& rect : rects(60)) {
        const double truth =
            rect.brute([](const vec3& wi) { return double(wi.z) * 0.31830988618379; });
        // Cells on the horizon count whole or not at all, with little light.
        EXPECT_NEAR(rect.share(vec3(0.0f, 0.0f, 1.0f), same), truth, 2e-3 * truth + 2e-5);
        const float reach = std::abs(rect.u.z) + std::abs(rect.v.z);
        cut += std::abs(rect.centre.z) < reach;
    }
    EXPECT_GT(cut, 8);
}

TEST(Ltc, AllDirectionsHaveAllLight) {
    vec3 corners[sh::LTC_CORNERS] = {vec3(-1e4f, -1e4f, 1.0f), vec3(1e4f, -1e4f, 1.0f),
                                     vec3(1e4f, 1e4f, 1.0f), vec3(-1e4f, 1e4f, 1.0f)};
    for (const float alpha : {0.02f, 0.3f, 1.0f})
        for (const float mu : {0.02f, 0.5f, 1.0f}) {
            const vec3 wo(std::sqrt(1.0f - mu * mu), 0.0f, mu);
            const float share = sh::ltcShare(corners, 4, sh::ltcMicrofacets(wo, alpha));
            EXPECT_LE(share, 1.0f);
            EXPECT_GT(share, 0.9f) << alpha << " " << mu;
        }
}

TEST(Ltc, FacetsAreWithinTheirBound) {
    test::Error error;
    for (const float alpha : {0.05f, 0.1f, 0.25f, 0.5f, 1.0f})
        for (const float mu : {0.1f, 0.4f, 0.7f, 0.95f}) {
            const MicrofacetLobe lobe(mu, alpha);
            const sh::vec4 map = sh::ltcMicrofacets(lobe.wo, alpha);
            for (const Rect& rect : rects(24))
                error.add(rect.share(lobe.wo, map) - rect.brute(lobe));
        }
    std::printf("shares of facets: RMSE %.4f, largest error %.4f\n", error.rms(), error.largest);
    EXPECT_LT(error.rms(), 0.012);
    EXPECT_LT(error.largest, 0.1);
}

TEST(Ltc, DegenerateOutlinesGiveNumbers) {
    const sh::vec4 map = sh::ltcMicrofacets(vec3(1.0f, 0.0f, 0.0f), 0.0f);
    vec3 corners[sh::LTC_CORNERS] = {};
    EXPECT_EQ(sh::ltcShare(corners, 4, map), 0.0f);
    for (vec3& c : corners)
        c = vec3(0.0f, 0.0f, 1.0f);
    EXPECT_EQ(sh::ltcShare(corners, 16, map), 0.0f);
    corners[0] = vec3(1.0f, 0.0f, -1.0f);
    EXPECT_TRUE(std::isfinite(sh::ltcShare(corners, 3, map)));
}

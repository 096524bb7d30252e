// SPDX-License-Identifier: Apache-2.0
// The tree of photons, and the radius that blocks have.
#include "hdDelegate/embree/caustics/photonPass.h"
#include "hdDelegate/embree/sampleBlock.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace patina {

namespace {

std::vector<Photon> scattered(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-1.0f, 1.0f);
    std::vector<Photon> photons(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) {
        // A third lies on a plane, as photons do, and some in one place.
        const float height = i % 3 == 0 ? 0.0f : place(random);
        photons[size_t(i)].position =
            i % 50 == 0 ? vec3(0.5f) : vec3(place(random), height, place(random));
        photons[size_t(i)].flux = vec3(1.0f);
        photons[size_t(i)].bounces = i;
    }
    return photons;
}

} // namespace

TEST(PhotonMap, VisitsAllWithinTheRadiusOnce) {
    const std::vector<Photon> photons = scattered(2000, 3);
    const PhotonMap map(photons);
    EXPECT_EQ(map.size(), photons.size());
    for (const float radius : {0.0f, 0.05f, 0.3f, 4.0f})
        for (const vec3 point : {vec3(0.0f), vec3(0.5f), vec3(1.0f, 0.0f, -1.0f), vec3(3.0f)}) {
            std::multiset<int> wanted, found;
            for (const Photon& p : photons)
                if (glm::dot(p.position - point, p.position - point) < radius * radius)
                    wanted.insert(p.bounces);
            map.visit(point, radius, [&](const Photon& p) { found.insert(p.bounces); });
            EXPECT_EQ(found, wanted);
        }
}

TEST(PhotonMap, LeavesOutWhatCameNowhere) {
    std::vector<Photon> photons = scattered(7, 1);
    photons[2].flux = photons[6].flux = vec3(0.0f);
    const PhotonMap map(photons);
    EXPECT_EQ(map.size(), 5u);
    EXPECT_TRUE(PhotonMap().empty());
    PhotonMap().visit(vec3(0.0f), 1.0f, [](const Photon&) { FAIL(); });
}

TEST(SampleBlock, RadiusShrinksAsKnausAndZwickerSay) {
    // Their sequence falls as a power of the number of passes: r^2 ~ k^(2/3 - 1).
    EXPECT_EQ(SampleBlock::radius(0), 1.0f);
    const float far = SampleBlock::radius(8000), near = SampleBlock::radius(1000);
    EXPECT_NEAR(std::pow(far / near, 2.0f), 0.5f, 1e-3f); // 8^(-1/3)
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/splitting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace patina;

namespace {

/// A number in [0, 1) for each sample of each pixel.
float noise(int x, int y, uint32_t index, int salt) {
    const double n =
        std::sin(x * 12.9898 + y * 78.233 + index * 37.719 + salt * 4.581) * 43758.5453;
    return float(n - std::floor(n));
}

/// Paths of a grey image whose two parts are noisy by a share, 0 to 1, and cost so many rays each.
struct Image {
    float lights = 0.0f, branches = 0.0f, lightCost = 0.6f, branchCost = 4.0f;

    SplitProbe operator()(int x, int y, uint32_t index) const {
        SplitProbe probe;
        vec3 sum(0.0f);
        float cost = 1.0f;
        for (int i = 0; i < 4; ++i) {
            const bool isLight = i < 2;
            probe.begin(isLight ? i : SplitProbe::Branch + i - 2, sum, cost);
            const float share = isLight ? lights : branches;
            sum += vec3(0.25f + 0.25f * share * (2.0f * noise(x, y, index, i) - 1.0f));
            cost += isLight ? lightCost : branchCost;
            if (i == 1) probe.begin(SplitProbe::Between, sum, cost);
        }
        probe.end(sum, cost);
        return probe;
    }
    Splitting choose(const Splitting& wanted = {0, 0}) const {
        return chooseSplitting(320, 180, wanted, *this);
    }
};

} // namespace

TEST(Splitting, GoesWhereTheNoiseIs) {
    EXPECT_EQ(Image().choose().lightSamples, 1);
    EXPECT_EQ(Image().choose().branches, 1);
    const Splitting lit = Image{1.0f, 0.0f, 0.1f, 1.0f}.choose();
    EXPECT_EQ(lit.lightSamples, Splitting::mostLightSamples);
    EXPECT_EQ(lit.branches, 1);
    // What the way to the surface costs is saved, if it is dear beside a branch.
    const Splitting bounced = Image{0.0f, 1.0f, 0.1f, 0.2f}.choose();
    EXPECT_EQ(bounced.lightSamples, 1);
    EXPECT_EQ(bounced.branches, Splitting::mostBranches);
    EXPECT_EQ((Image{0.0f, 1.0f, 0.1f, 100.0f}.choose().branches), 1);
}

TEST(Splitting, BlackImagesTakeOneOfEach) {
    const auto black = [](int, int, uint32_t) {
        SplitProbe probe;
        probe.end(vec3(0.0f), 1.0f);
        return probe;
    };
    const Splitting choice = chooseSplitting(64, 64, {0, 0}, black);
    EXPECT_EQ(choice.lightSamples, 1);
    EXPECT_EQ(choice.branches, 1);
}

TEST(Splitting, KeepsWhatIsAskedFor) {
    const Image image{1.0f, 1.0f};
    EXPECT_EQ(image.choose({3, 0}).lightSamples, 3);
    EXPECT_EQ(image.choose({0, 5}).branches, 5);
    bool traced = false;
    const auto probe = [&](int, int, uint32_t) {
        traced = true;
        return SplitProbe();
    };
    const Splitting both = chooseSplitting(8, 8, {3, 5}, probe);
    EXPECT_EQ(both.lightSamples, 3);
    EXPECT_EQ(both.branches, 5);
    EXPECT_FALSE(traced);
}

TEST(Splitting, LeavesOutWhatIsNoNumber) {
    const Image image{1.0f, 0.0f, 0.1f, 1.0f};
    const Splitting choice = chooseSplitting(320, 180, {0, 0}, [&](int x, int y, uint32_t i) {
        SplitProbe probe = image(x, y, i);
        if (x % 7 == 0) probe.end(vec3(std::numeric_limits<float>::quiet_NaN()), 1.0f);
        return probe;
    });
    EXPECT_EQ(choice.lightSamples, image.choose().lightSamples);
    EXPECT_EQ(choice.branches, image.choose().branches);
}

TEST(SplitProbe, StepsThatAreNotTakenCollectNothing) {
    SplitProbe probe;
    probe.begin(SplitProbe::Branch, vec3(1.0f), 2.0f);
    probe.begin(SplitProbe::SecondBranch, vec3(3.0f), 5.0f);
    probe.end(vec3(4.0f), 9.0f);
    EXPECT_EQ(probe.radiance(SplitProbe::LightSample), vec3(0.0f));
    EXPECT_EQ(probe.radiance(SplitProbe::Branch), vec3(2.0f));
    EXPECT_EQ(probe.radiance(SplitProbe::SecondBranch), vec3(1.0f));
    EXPECT_EQ(probe.cost(SplitProbe::Branch), 3.0f);
    EXPECT_EQ(probe.cost(SplitProbe::SecondBranch), 4.0f);
    EXPECT_EQ(probe.cost(), 9.0f);
}

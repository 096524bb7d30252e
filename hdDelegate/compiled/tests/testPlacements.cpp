// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/placements.h"
#include "hdDelegate/scene/tests/prims.h"

#include "base/limits.h"
#include "base/tests/testTools.h"

namespace patina {
namespace {

std::shared_ptr<Instancer> instancer(const std::string& path, const std::string& group,
                                     const std::vector<std::string>& prototypes,
                                     const std::vector<int>& indices) {
    auto prim = makePrim<Instancer>(path);
    prim->group = group;
    prim->prototypes = prototypes;
    prim->prototypeIndices = indices;
    for (size_t i = 0; i < indices.size(); ++i)
        prim->transforms.push_back(translate(float(i), 0, 0));
    return prim;
}

struct Fixture : ::testing::Test {
    SceneState state;
    RenderSettings settings;
    mutable Diagnostics diagnostics;

    void add(const std::shared_ptr<Instancer>& prim) { state.instancers.set(prim->path, prim); }

    /// Of each place the instances that lead to it, innermost first.
    std::vector<std::string> placesOf(const std::string& group, size_t* steps = nullptr) const {
        std::vector<std::string> found;
        Placements(state, settings, diagnostics)
            .forPlaces(
                group, std::string(),
                [&](const Instancer& prim, uint32_t i, int, std::string& place) {
                    if (steps) ++*steps;
                    place += prim.path + std::to_string(i);
                    return true;
                },
                [&](const std::string& place) { found.push_back(place); });
        return found;
    }
};

using Found = std::vector<std::string>;

TEST_F(Fixture, FindsThePlacesOfAPrototypeThroughAllLevels) {
    add(instancer("/trees", "", {"tree", "bush"}, {0, 1, 0}));
    add(instancer("/leaves", "tree", {"leaf"}, {0, 0}));
    EXPECT_EQ(placesOf(""), Found{""});
    EXPECT_EQ(placesOf("bush"), Found{"/trees1"});
    EXPECT_EQ(placesOf("leaf"),
              (Found{"/leaves0/trees0", "/leaves0/trees2", "/leaves1/trees0", "/leaves1/trees2"}));
    EXPECT_EQ(placesOf("nowhere"), Found());
}

TEST_F(Fixture, LooksAtTheInstancesOfThePrototypeAlone) {
    add(instancer("/one", "", {"a"}, {0}));
    add(instancer("/many", "", {"b"}, std::vector<int>(1000, 0)));
    size_t steps = 0;
    placesOf("a", &steps);
    EXPECT_EQ(steps, 1u);
}

TEST_F(Fixture, LeavesOutBadIndicesAndWhatIsNotDrawn) {
    add(instancer("/bad", "", {"a"}, {-1, 0, 1}));
    add(instancer("/out/of", "", {"a"}, {0}));
    auto unseen = instancer("/unseen", "", {"a"}, {0});
    unseen->visibility = Visibility::all(false);
    add(unseen);
    settings.excludePaths = {"/out"};
    EXPECT_EQ(placesOf("a"), Found{"/bad1"});
    EXPECT_EQ(Placements(state, settings, diagnostics).drawn().size(), 1u);
}

TEST_F(Fixture, EndsWhereInstancesAreNestedInThemselves) {
    add(instancer("/loop", "a", {"a"}, {0}));
    add(instancer("/top", "", {"a"}, {0}));
    // Once for each level that there may be around the first.
    EXPECT_EQ(placesOf("a").size(), size_t(Placements::maxDepth) + 1);
}

TEST_F(Fixture, FollowsNoWaysThatDoNotComeToTheWorld) {
    // Nine levels of five instances each lead from the mesh outwards, to nine levels more.
    const int levels = 18;
    for (int i = 0; i < levels; ++i)
        add(instancer("/i" + std::to_string(i), i == 0 ? "" : "g" + std::to_string(i),
                      {"g" + std::to_string(i + 1)},
                      i < levels / 2 ? std::vector<int>{0} : std::vector<int>(5, 0)));
    size_t steps = 0;
    EXPECT_TRUE(placesOf("g" + std::to_string(levels), &steps).empty());
    EXPECT_EQ(steps, 0u);
    EXPECT_EQ(placesOf("g9").size(), 1u);
    EXPECT_TRUE(placesOf("g10").empty());
}

TEST_F(Fixture, KeepsTheOrderOfGroupsAndPaths) {
    add(instancer("/b", "", {"a"}, {0}));
    add(instancer("/a", "", {"a"}, {0}));
    add(instancer("/0", "z", {"a"}, {0}));
    add(instancer("/z", "", {"z"}, {0}));
    EXPECT_EQ(placesOf("a"), (Found{"/a0", "/b0", "/00/z0"}));
    const Placements placements(state, settings, diagnostics);
    ASSERT_EQ(placements.in("").size(), 3u);
    EXPECT_EQ(placements.in("")[0]->path, "/a");
}

/// Eight levels of ten instances each are a hundred million places, from eighty transforms.
TEST_F(Fixture, LeavesOutTheInstancersOfMostInstancesBeyondTheLimit) {
    std::string group;
    for (int level = 0; level < 8; ++level) {
        const std::string next = "g" + std::to_string(level);
        add(instancer("/" + next, group, {next}, std::vector<int>(10, 0)));
        group = next;
    }
    ASSERT_EQ(setLimits({{"instances", 2000}}), "");
    EXPECT_EQ(placesOf("g2").size(), 1000u); // 10 + 100 + 1000 are within it
    EXPECT_EQ(placesOf("g7").size(), 0u);
    EXPECT_EQ(Placements(state, settings, diagnostics).drawn().size(), 3u);
    EXPECT_EQ(onlyWarning(diagnostics), "/g7  the scene has more instances than 2000 (--limit "
                                        "instances); the instancer is left out, and 4 others");
    setLimits({});
    EXPECT_EQ(Placements(state, settings, diagnostics).drawn().size(), 8u);
}

} // namespace
} // namespace patina

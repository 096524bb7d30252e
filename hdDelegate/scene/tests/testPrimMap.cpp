// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/primMap.h"

#include <gtest/gtest.h>

#include <random>

namespace patina {
namespace {

using Map = PrimMap<int>;

std::string path(int i) {
    return "/set/prim" + std::to_string(i);
}

Map filled(int count) {
    Map::Changes changes;
    for (int i = 0; i < count; ++i)
        changes[path(i)] = std::make_shared<const int>(i);
    return Map().changed(changes);
}

std::vector<std::string> differences(const Map& a, const Map& b) {
    std::vector<std::string> found;
    Map::forDifferences(
        a, b, [&](const std::string& at, const Map::Value& before, const Map::Value& now) {
            found.push_back((before ? now ? "=" : "-" : "+") + at);
        });
    return found;
}

TEST(PrimMap, isEmptyAtFirst) {
    const Map map;
    EXPECT_TRUE(map.empty());
    EXPECT_EQ(map.begin(), map.end());
    EXPECT_EQ(map.find("/a"), map.end());
    EXPECT_THROW(map.at("/a"), std::out_of_range);
    EXPECT_EQ(map, Map().changed({}));
}

TEST(PrimMap, tellsWhatDiffers) {
    const Map before = filled(1000);
    const Map after = before.changed({{path(7), nullptr},
                                      {path(500), std::make_shared<const int>(-1)},
                                      {"/zebra", std::make_shared<const int>(0)},
                                      {"/none", nullptr}});
    EXPECT_EQ(after.size(), 1000u);
    EXPECT_EQ(differences(before, after),
              (std::vector<std::string>{"=" + path(500), "-" + path(7), "+/zebra"}));
    EXPECT_EQ(differences(after, before),
              (std::vector<std::string>{"=" + path(500), "+" + path(7), "-/zebra"}));
    EXPECT_NE(before, after);
    EXPECT_EQ(*before.at(path(500)), 500) << "the map before is as it was";
}

TEST(PrimMap, equalObjectsAreEqualMapsWhateverTheirBlocks) {
    Map::Changes all;
    Map oneByOne;
    for (int i = 0; i < 300; ++i) {
        all[path(i)] = std::make_shared<const int>(i);
        oneByOne.set(path(i), all[path(i)]);
    }
    EXPECT_EQ(oneByOne, Map().changed(all));
    oneByOne.set(path(3), std::make_shared<const int>(3)); // an equal number, but another object
    EXPECT_NE(oneByOne, Map().changed(all));
}

TEST(PrimMap, followsAMapOfTheStandardLibrary) {
    std::mt19937 random(20261123);
    Map map;
    Map::Changes expected;
    for (int edit = 0; edit < 400; ++edit) {
        Map::Changes changes;
        const int count = edit % 7 == 0 ? 200 : int(random() % 4);
        for (int i = 0; i < count; ++i) {
            const bool removal = edit > 200 && random() % 4 != 0; // first it grows, then it shrinks
            changes[path(int(random() % 2000))] =
                removal ? nullptr : std::make_shared<const int>(int(random()));
        }
        const Map before = map;
        map = before.changed(changes);
        size_t differing = 0;
        for (const auto& change : changes) {
            const auto found = expected.find(change.first);
            differing += (found == expected.end() ? nullptr : found->second) != change.second;
            if (change.second)
                expected[change.first] = change.second;
            else if (found != expected.end())
                expected.erase(found);
        }
        ASSERT_EQ(map.size(), expected.size());
        ASSERT_EQ(differences(before, map).size(), differing);
        auto item = map.begin();
        for (const auto& other : expected) {
            ASSERT_EQ(item->first, other.first);
            ASSERT_EQ(item->second, other.second);
            ASSERT_EQ(map.at(other.first), other.second);
            ++item;
        }
        ASSERT_EQ(item, map.end());
    }
}

TEST(PrimMap, sharesWhatAnEditDoesNotTouch) {
    // Counted by owners: an item that is copied has one owner more.
    const Map before = filled(10000);
    const Map after = before.changed({{path(5000), std::make_shared<const int>(-1)}});
    size_t copied = 0;
    for (const auto& item : before)
        copied += item.second.use_count() > 1;
    EXPECT_LE(copied, 2 * Map::blockSize);
}

} // namespace
} // namespace patina

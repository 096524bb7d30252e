// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/settingRows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace patina;

TEST(SettingRows, AreEachFieldOnceWithADefaultThatIsTaken) {
    const RenderSettings defaults;
    std::set<std::string> names;
    for (const SettingRow& row : settingRows()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        std::visit(
            [&](auto member) {
                using T = std::decay_t<decltype(defaults.*member)>;
                bool taken = true;
                if constexpr (std::is_arithmetic_v<T>)
                    taken = row.takes(double(defaults.*member));
                else if constexpr (std::is_same_v<T, std::string>)
                    taken = row.takes(defaults.*member);
                EXPECT_TRUE(taken) << row.name;
            },
            row.member);
    }
}

TEST(SettingRows, TakeTheirRangeAndOneValueBesides) {
    for (const SettingRow& row : settingRows())
        if (row.name == "tolerance") {
            EXPECT_TRUE(row.takes(0.0) && row.takes(0.5) && row.takes(-1.0));
            EXPECT_FALSE(row.takes(-0.5));
            EXPECT_FALSE(row.takes(std::nan("")));
        } else if (row.name == "cullStyle") {
            EXPECT_TRUE(row.takes("back"));
            EXPECT_FALSE(row.takes("sideways"));
        }
}

TEST(SettingRows, SayWhatChangesLights) {
    std::set<std::string> found;
    RenderSettings settings;
    settings.enableMotionBlur = false;
    for (const SettingRow& row : settingRows())
        if (row.ofLights) {
            found.insert(row.name);
            EXPECT_EQ(row.number(settings), row.name == "enableMotionBlur" ? 0.0 : 1.0);
        }
    EXPECT_EQ(found, (std::set<std::string>{"enableSceneLights", "domeLightCameraVisibility",
                                            "enableMotionBlur"}));
}

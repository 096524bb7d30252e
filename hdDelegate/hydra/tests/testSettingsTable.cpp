// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/settingsTable.h"

#include <gtest/gtest.h>
#include <pxr/imaging/hd/tokens.h>

#include <set>

using namespace patina;

namespace {

HdPatinaSettings with(const char* name, const VtValue& value, std::string* problem = nullptr) {
    HdPatinaSettings settings;
    const std::string text = applySetting(settingKey(TfToken(name)), value, settings);
    if (problem) *problem = text;
    return settings;
}
std::string problemOf(const char* name, const VtValue& value) {
    std::string problem;
    with(name, value, &problem);
    return problem;
}

} // namespace

TEST(SettingsTable, DescriptorsHaveTheDefaultsOfTheSettings) {
    const HdPatinaSettings defaults;
    std::set<TfToken> keys;
    for (const auto& descriptor : settingDescriptors()) {
        EXPECT_TRUE(keys.insert(descriptor.key).second) << descriptor.key.GetText();
        EXPECT_FALSE(descriptor.name.empty());
        HdPatinaSettings settings;
        EXPECT_EQ(applySetting(descriptor.key, descriptor.defaultValue, settings), "");
        const VtValue initial = descriptor.key == TfToken("samples") ? VtValue(defaults.samples)
                                : descriptor.key == TfToken("filterRadius")
                                    ? VtValue(defaults.filterRadius)
                                    : descriptor.defaultValue;
        EXPECT_EQ(descriptor.defaultValue, initial);
    }
    EXPECT_GE(keys.size(), 20u);
}

TEST(SettingsTable, HydrasNamesMeanOurs) {
    EXPECT_EQ(settingKey(HdRenderSettingsTokens->convergedSamplesPerPixel), TfToken("samples"));
    EXPECT_EQ(settingKey(HdRenderSettingsTokens->enableInteractive), TfToken("interactive"));
    EXPECT_EQ(settingKey(HdRenderSettingsTokens->threadLimit), TfToken("threads"));
    EXPECT_EQ(settingKey(TfToken("patina:maxDepth")), TfToken("maxDepth"));
    EXPECT_EQ(settingKey(TfToken("patina:method:energyCompensation")),
              TfToken("method:energyCompensation"));
    EXPECT_TRUE(settingKey(TfToken("houdini:frame")).IsEmpty());
}

TEST(SettingsTable, NumbersOfEveryTypeAreTaken) {
    EXPECT_EQ(with("samples", VtValue(7)).samples, 7);
    EXPECT_EQ(with("samples", VtValue(int64_t(7))).samples, 7);
    EXPECT_EQ(with("samples", VtValue(7.9)).samples, 7);
    EXPECT_EQ(with("samples", VtValue(std::string("7"))).samples, 7);
    EXPECT_EQ(with("enableShadows", VtValue(0)).enableShadows, false);
    EXPECT_EQ(with("enableShadows", VtValue(std::string("off"))).enableShadows, false);
    EXPECT_EQ(with("cullStyle", VtValue(TfToken("back"))).cullStyle, "back");
    HdPatinaSettings untouched;
    const TfToken fresnel = settingKey(TfToken("method:fresnel"));
    EXPECT_NE(applySetting(fresnel, VtValue(std::string("schlik")), untouched), "");
    EXPECT_TRUE(untouched.methods.empty());
    EXPECT_EQ(with("method:energyCompensation", VtValue(std::string("none")))
                  .methods["energyCompensation"],
              "none");
}

TEST(SettingsTable, NonsenseIsRefusedWithAReason) {
    EXPECT_EQ(with("samples", VtValue(0)).samples, HdPatinaSettings().samples);
    const std::pair<const char*, VtValue> nonsense[] = {
        {"samples", VtValue(0)},
        {"samples", VtValue(std::string("many"))},
        {"tolerance", VtValue(-0.5)},
        {"tolerance", VtValue(1e300)},
        {"tolerance", VtValue(std::string("nan"))},
        {"cullStyle", VtValue(std::string("sideways"))},
        {"seed", VtValue(4294967296.0)}};
    for (const auto& [name, value] : nonsense)
        EXPECT_NE(problemOf(name, value), "") << name << " " << value;
}

TEST(SettingsTable, NumbersThatNoIntegerHoldsAreRefused) {
    const int samples = HdPatinaSettings().samples, threads = HdPatinaSettings().threads;
    for (double number :
         {-4294967295.0, 4294967297.0, 2147483648.0, -2147483649.0, 1e300, -1e300}) {
        EXPECT_EQ(with("samples", VtValue(number)).samples, samples) << number;
        const std::string problem = problemOf("samples", VtValue(number));
        EXPECT_NE(problem.find("is not allowed"), std::string::npos) << problem;
    }
    EXPECT_EQ(with("threads", VtValue(4294967297.0)).threads, threads);
    EXPECT_EQ(with("maxDepth", VtValue(4294967295.0)).maxDepth, HdPatinaSettings().maxDepth)
        << "is no -1";
    EXPECT_EQ(with("samples", VtValue(2147483647.0)).samples, 2147483647);
}

TEST(SettingsTable, SeedsHaveAllBits) {
    for (double number : {0.0, 2147483648.0, 4294967295.0})
        EXPECT_EQ(with("seed", VtValue(number)).seed, uint32_t(number));
    EXPECT_EQ(with("seed", VtValue(-1)).seed, 4294967295u) << "as hosts keep it";
}

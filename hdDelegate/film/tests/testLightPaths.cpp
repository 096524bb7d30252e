// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/lightPaths/lightPathAutomaton.h"
#include "hdDelegate/film/tests/filmFixtures.h"

namespace patina {

namespace {

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += text;
    return all;
}

/// As many labels as a list of them, each of a prefix and a number.
std::string labels(const std::string& prefix, int count) {
    std::string all;
    for (int i = 0; i < count; ++i)
        all += "'" + prefix + std::to_string(i) + "'";
    return all;
}

/// About 1,860 states.
std::string large(const std::string& prefix, int count) {
    return "C" + repeated(".{64}", 29) + "<L.[" + labels(prefix, count) + "]>";
}

std::vector<std::string> lightGroups(int groups, int orders) {
    std::vector<std::string> expressions;
    for (int group = 0; group < groups; ++group)
        for (int order = 0; order < orders; ++order)
            expressions.push_back("C.{" + std::to_string(order) + "}<[LO].'group" +
                                  std::to_string(group) + "'>");
    return expressions;
}

std::string problemOf(const std::vector<std::string>& expressions) {
    return reasonOf([&] { LightPathSet{expressions}; });
}

} // namespace

TEST(LightPaths, LabelsDoNotMultiplyTheTable) {
    const LightPathSet set({large("a", 180)});
    EXPECT_EQ(set.automata()[0].size(), 1860);
    EXPECT_NE(problemOf({"C((.?){64}){64}<L.[" + labels("a", 180) + "]>"}).find("too many states"),
              std::string::npos);
}

TEST(LightPaths, EveryLabelOfAnotherExpressionIsAnyOther) {
    const LightPathSet set({"C<L.'a'>", "C<L.[^'b']>", "C<RD>L"});
    const auto accepted = [&](size_t expression, const std::string& label) {
        const LightPathAutomaton& a = set.automata()[expression];
        const int camera = a.next(a.start(), set.symbol({EventType::Camera, EventScatter::None}));
        const LightEvent light{EventType::Light, EventScatter::None, set.labels().of(label)};
        return a.accepts(a.next(camera, set.symbol(light)));
    };
    const std::tuple<size_t, const char*, bool> cases[] = {
        {0, "a", true}, {0, "b", false}, {1, "a", true}, {1, "b", false},
        {1, "c", true}, {1, "", true},   {2, "a", false}};
    for (const auto& [expression, label, accepts] : cases)
        EXPECT_EQ(accepted(expression, label), accepts) << expression << " " << label;
}

TEST(LightPaths, WhatAllExpressionsTakeIsBounded) {
    std::vector<std::string> different, many;
    for (int i = 0; i < 100; ++i)
        different.push_back(large("l" + std::to_string(i) + "_", 100));
    EXPECT_NE(problemOf(different).find("at most 1024 labels"), std::string::npos);
    EXPECT_NE(problemOf(std::vector<std::string>(100, large("a", 1))).find("too many states"),
              std::string::npos);
    EXPECT_NE(problemOf(std::vector<std::string>(257, "CL")).find("at most 256"),
              std::string::npos);
}

TEST(LightPaths, LightGroupsWithTenExpressionsEachHaveRoom) {
    const LightPathSet set(lightGroups(20, 10));
    EXPECT_EQ(set.automata().size(), 200u);
    EXPECT_EQ(set.labels().count(), 21);
}

TEST(LightPaths, AovsThatThereIsNoRoomForAreLeftOut) {
    std::vector<std::string> names = {"color", "diffuse"};
    for (int i = 0; i < 20; ++i)
        names.push_back("large" + std::to_string(i) + "=lpe:" + large("a", 1));
    names.push_back("key=lpe:C.*<L.'key'>");
    const std::vector<Message> problems = leaveOutLightPaths(names);
    ASSERT_EQ(problems.size(), 3u);
    EXPECT_EQ(problems[0].id, MessageId::aovPathLeftOut);
    EXPECT_EQ(problems[0].fields[0], "large17");
    EXPECT_EQ(names.size(), 20u);
    EXPECT_EQ(names[1], "diffuse");
    EXPECT_EQ(names.back(), "key=lpe:C.*<L.'key'>") << "those that need little stay";
    std::vector<std::string> expressions;
    for (const AovSpec& aov : renderedAovs(names))
        if (!aov.paths.empty()) expressions.push_back(aov.paths);
    EXPECT_EQ(problemOf(expressions), "");
}

} // namespace patina

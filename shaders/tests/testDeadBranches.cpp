// SPDX-License-Identifier: Apache-2.0
// What conditions leave out of a shader's text is blanked, and nothing that a driver may read.

#include "shaders/deadBranches.h"
#include "shaders/unusedFunctions.h"

#include <algorithm>

#include <gtest/gtest.h>

using patina::withoutDeadBranches;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST(DeadBranches, NamesThatNobodyDefines) {
    const std::string out =
        withoutDeadBranches("#define A 1\n"
                            "#ifdef A\nint a;\n#else\nint notA;\n#endif\n"
                            "#ifndef B\nint notB;\n#else\nint b;\n#endif\n"
                            "#undef A\n#ifdef A\nint again;\n#endif\nint end;\n");
    EXPECT_TRUE(has(out, "int a;") && has(out, "int notB;") && has(out, "int end;"));
    EXPECT_FALSE(has(out, "int notA;") || has(out, "int b;") || has(out, "int again;"));
}

TEST(DeadBranches, ConditionsInConditions) {
    const std::string out = withoutDeadBranches("#ifdef A\n#define B\n#ifndef C\nint c;\n#endif\n"
                                                "int a;\n#else\n#ifndef B\nint notB;\n#endif\n"
                                                "#endif\nint end;\n");
    EXPECT_TRUE(has(out, "int notB;") && has(out, "int end;"));
    EXPECT_FALSE(has(out, "int c;") || has(out, "int a;") || has(out, "#define B"));
}

// No expression is evaluated: what stands under one stays, and what it defines may be there.
TEST(DeadBranches, ExpressionsAndNamesOfTheDriverStay) {
    const std::string text =
        "#if N > 0\n#define M\nint n;\n#elif N < 0\nint less;\n#else\nint none;\n"
        "#endif\n#ifdef M\nint m;\n#else\nint notM;\n#endif\n"
        "#ifdef GL_ES\nint es;\n#else\nint notEs;\n#endif\n";
    EXPECT_EQ(withoutDeadBranches(text), text);
    const std::string after = withoutDeadBranches("#ifdef A\nint a;\n#elif N\nint n;\n#endif\n");
    EXPECT_TRUE(has(after, "int n;"));
    EXPECT_FALSE(has(after, "int a;"));
}

TEST(DeadBranches, LinesKeepTheirNumbers) {
    const std::string text = "// #ifdef B\n#ifdef A\n#define X \\\n    one\n#line 7 1\n#endif\n"
                             "/* #define A\n*/ int end;";
    const std::string out = withoutDeadBranches(text);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), std::count(out.begin(), out.end(), '\n'));
    EXPECT_FALSE(has(out, "one") || has(out, "#line"));
    EXPECT_TRUE(has(out, "#ifdef A\n") && has(out, "int end;"));
}

TEST(DeadBranches, WhatTheyCallGoesWithThem) {
    const std::string text =
        "float f() { return 1.0; }\nvoid main() {\n#ifdef A\n    f();\n#endif\n}\n";
    EXPECT_TRUE(has(patina::withoutUnusedFunctions(text), "float f()"));
    EXPECT_FALSE(has(patina::withoutUnusedFunctions(withoutDeadBranches(text)), "float f()"));
}

// SPDX-License-Identifier: Apache-2.0
// Functions that a stage does not need are left out of its text, and nothing else; what conditions
// leave out is blanked, and nothing that a driver may read.

#include "shaders/deadBranches.h"
#include "shaders/unusedFunctions.h"

#include <algorithm>

#include <gtest/gtest.h>

using patina::withoutDeadBranches;
using patina::withoutUnusedFunctions;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST(UnusedFunctions, StaysWhatMainReaches) {
    const std::string out =
        withoutUnusedFunctions("struct S { float unused; };\n"
                               "float unused(float x) { return x; }\n"
                               "float last(float x) {\n    return x;\n}\n"
                               "float first(INOUT(S) s) { return last(1.0); }\n"
                               "void main() { S s; first(s); s.unused = 2.0; }\n");
    EXPECT_FALSE(has(out, "unused(float"));
    EXPECT_TRUE(has(out, "float last(float x) {\n    return x;\n}"));
    EXPECT_TRUE(has(out, "first(INOUT(S) s)"));
    EXPECT_TRUE(has(out, "struct S { float unused; };"));
}

TEST(UnusedFunctions, OverloadsStayTogether) {
    const std::string out = withoutUnusedFunctions(
        "float f(float x) { return g(x); }\nvec2 f(vec2 x) { return h(x); }\n"
        "float g(float x) { return x; }\nvec2 h(vec2 x) { return x; }\n"
        "void main() { f(1.0); }\n");
    EXPECT_TRUE(has(out, "vec2 f(vec2 x)") && has(out, "g(float") && has(out, "h(vec2"));
}

TEST(UnusedFunctions, MacrosAndConstantsNeedWhatTheyName) {
    const std::string out = withoutUnusedFunctions("float inMacro() { return 1.0; }\n"
                                                   "float inValue() { return 1.0; }\n"
                                                   "float declared();\n"
                                                   "float declared() { return 1.0; }\n"
                                                   "#define ONE \\\n    inMacro()\n"
                                                   "float one = inValue();\n"
                                                   "void main() {}\n");
    EXPECT_TRUE(has(out, "float inMacro() {"));
    EXPECT_TRUE(has(out, "float inValue() {"));
    EXPECT_FALSE(has(out, "float declared() {"));
    EXPECT_TRUE(has(out, "float declared();"));
}

TEST(UnusedFunctions, LinesKeepTheirNumbersAndCommentsGo) {
    const std::string text = "/* two\nlines { */\nvoid gone() {\n    // }\n}\n#line 1 3\n"
                             "void main() { }\n";
    const std::string out = withoutUnusedFunctions(text);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), std::count(out.begin(), out.end(), '\n'));
    EXPECT_FALSE(has(out, "gone") || has(out, "two"));
    EXPECT_TRUE(has(out, "\n#line 1 3\nvoid main() { }\n"));
}

TEST(UnusedFunctions, CallersKeepWhatTheyName) {
    const std::string out = withoutUnusedFunctions(
        "float part() { return 1.0; }\nfloat whole() { return part(); }\nvoid gone() { }\n",
        "void other() { whole(); }");
    EXPECT_TRUE(has(out, "part") && has(out, "whole"));
    EXPECT_FALSE(has(out, "gone"));
}

// Parts that the preprocessor may still take apart are let be.
TEST(UnusedFunctions, PartsOfConditionsStay) {
    const std::string halves =
        "#ifdef A\nvoid f() {\n#else\nvoid g() {\n#endif\n}\nvoid main() {}\n";
    EXPECT_EQ(withoutUnusedFunctions(halves), halves);
    const std::string defining = "void f() {\n#define X 1\n}\nvoid main() {}\n";
    EXPECT_EQ(withoutUnusedFunctions(defining), defining);
    const std::string across = "void f() {\n#if A\n#endif\n}\nvoid main() {}\n";
    EXPECT_FALSE(has(withoutUnusedFunctions(across), "void f"));
}

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
    EXPECT_TRUE(has(withoutUnusedFunctions(text), "float f()"));
    EXPECT_FALSE(has(withoutUnusedFunctions(withoutDeadBranches(text)), "float f()"));
}

// SPDX-License-Identifier: Apache-2.0
// Functions that a stage does not need are left out of its text, and nothing else.

#include "shaders/unusedFunctions.h"

#include <algorithm>

#include <gtest/gtest.h>

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

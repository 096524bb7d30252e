// SPDX-License-Identifier: Apache-2.0
// Choices.

PATINA_FN vec4 nodeIfGreater(float a, float b, vec4 x, vec4 y) {
    return a > b ? x : y;
}
PATINA_FN vec4 nodeIfGreaterEq(float a, float b, vec4 x, vec4 y) {
    return a >= b ? x : y;
}
PATINA_FN vec4 nodeIfEqual(float a, float b, vec4 x, vec4 y) {
    return a == b ? x : y;
}
PATINA_FN bool nodeIsGreater(float a, float b) {
    return a > b;
}
PATINA_FN bool nodeIsGreaterEq(float a, float b) {
    return a >= b;
}
PATINA_FN bool nodeIsEqual(float a, float b) {
    return a == b;
}

PATINA_FN bool nodeAnd(bool a, bool b) {
    return a && b;
}
PATINA_FN bool nodeOr(bool a, bool b) {
    return a || b;
}
PATINA_FN bool nodeXor(bool a, bool b) {
    return a != b;
}
PATINA_FN bool nodeNot(bool a) {
    return !a;
}

// Indices below the first take the first; above the last there is nothing.
PATINA_FN vec4 nodeSwitch(vec4 v0, vec4 v1, vec4 v2, vec4 v3, vec4 v4, vec4 v5, vec4 v6, vec4 v7,
                          vec4 v8, vec4 v9, float which) {
    float i = max(floor(which), 0.0f);
    if (i < 5.0f) return i < 1.0f ? v0 : i < 2.0f ? v1 : i < 3.0f ? v2 : i < 4.0f ? v3 : v4;
    if (i < 10.0f) return i < 6.0f ? v5 : i < 7.0f ? v6 : i < 8.0f ? v7 : i < 9.0f ? v8 : v9;
    return vec4(0.0f);
}

// SPDX-License-Identifier: Apache-2.0
// Nodes that take values apart, put them together and change their type.

PATINA_FN vec4 nodeOpaque(vec3 x) {
    return vec4(x, 1.0f);
}
PATINA_FN vec3 nodeTwoToThree(vec2 x) {
    return vec3(x, 0.0f);
}
PATINA_FN vec4 nodeOpaqueZero(vec2 x) {
    return vec4(x, 0.0f, 1.0f);
}
PATINA_FN float nodeToInteger(float x) {
    return floor(x);
}
PATINA_FN bool nodeToBoolean(float x) {
    return x != 0.0f;
}

PATINA_FN vec2 nodeCombine2(float a, float b) {
    return vec2(a, b);
}
PATINA_FN vec3 nodeCombine3(float a, float b, float c) {
    return vec3(a, b, c);
}
PATINA_FN vec4 nodeCombine4(float a, float b, float c, float d) {
    return vec4(a, b, c, d);
}
PATINA_FN vec4 nodeCombine31(vec3 a, float b) {
    return vec4(a, b);
}
PATINA_FN vec4 nodeCombine22(vec2 a, vec2 b) {
    return vec4(a, b);
}

PATINA_FN float nodeExtract(vec4 v, int index, NodeSize size) {
    return v[min(max(index, 0), size - 1)];
}

PATINA_FN float nodeSeparate2(vec2 v, PATINA_OUT(float) y) {
    y = v.y;
    return v.x;
}
PATINA_FN float nodeSeparate3(vec3 v, PATINA_OUT(float) y, PATINA_OUT(float) z) {
    y = v.y;
    z = v.z;
    return v.x;
}
PATINA_FN float nodeSeparate4(vec4 v, PATINA_OUT(float) y, PATINA_OUT(float) z,
                              PATINA_OUT(float) w) {
    y = v.y;
    z = v.z;
    w = v.w;
    return v.x;
}

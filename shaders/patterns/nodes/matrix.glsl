// SPDX-License-Identifier: Apache-2.0
// Matrices. A row of the network is a column here; vectors are rows too and multiply from the left,
// so a matrix of the same columns multiplies from the right, and factors change places.

PATINA_FN mat3 nodeSame3(mat3 m) {
    return m;
}
PATINA_FN mat3 nodeAdd3(mat3 a, mat3 b) {
    return a + b;
}
PATINA_FN mat3 nodeAddScalar3(mat3 m, float x) {
    return m + x;
}
PATINA_FN mat3 nodeSubtract3(mat3 a, mat3 b) {
    return a - b;
}
PATINA_FN mat3 nodeSubtractScalar3(mat3 m, float x) {
    return m - x;
}
PATINA_FN mat3 nodeMultiply3(mat3 a, mat3 b) {
    return b * a;
}
// A matrix without an inverse has the identity for it. Out of line: it rounds alike wherever it is
// called.
PATINA_FN_RARE mat3 nodeInvert3(mat3 m) {
    float d = determinant(m);
    return d != 0.0f && isFinite(1.0f / d) ? inverse(m) : mat3(1.0f);
}
PATINA_FN mat3 nodeDivide3(mat3 a, mat3 b) {
    return nodeInvert3(b) * a;
}
PATINA_FN mat3 nodeTranspose3(mat3 m) {
    return transpose(m);
}
PATINA_FN float nodeDeterminant3(mat3 m) {
    return determinant(m);
}
PATINA_FN vec3 nodeExtractRow3(mat3 m, int index) {
    return m[min(max(index, 0), 2)];
}
PATINA_FN mat3 nodeIfGreater3(float a, float b, mat3 x, mat3 y) {
    return a > b ? x : y;
}
PATINA_FN mat3 nodeIfGreaterEq3(float a, float b, mat3 x, mat3 y) {
    return a >= b ? x : y;
}
PATINA_FN mat3 nodeIfEqual3(float a, float b, mat3 x, mat3 y) {
    return a == b ? x : y;
}
PATINA_FN mat3 nodeSwitch3(mat3 v0, mat3 v1, mat3 v2, mat3 v3, mat3 v4, mat3 v5, mat3 v6, mat3 v7,
                           mat3 v8, mat3 v9, float which) {
    float i = max(floor(which), 0.0f);
    if (i < 5.0f) return i < 1.0f ? v0 : i < 2.0f ? v1 : i < 3.0f ? v2 : i < 4.0f ? v3 : v4;
    if (i < 10.0f) return i < 6.0f ? v5 : i < 7.0f ? v6 : i < 8.0f ? v7 : i < 9.0f ? v8 : v9;
    return mat3(0.0f);
}

PATINA_FN mat4 nodeSame4(mat4 m) {
    return m;
}
PATINA_FN mat4 nodeAdd4(mat4 a, mat4 b) {
    return a + b;
}
PATINA_FN mat4 nodeAddScalar4(mat4 m, float x) {
    return m + x;
}
PATINA_FN mat4 nodeSubtract4(mat4 a, mat4 b) {
    return a - b;
}
PATINA_FN mat4 nodeSubtractScalar4(mat4 m, float x) {
    return m - x;
}
PATINA_FN mat4 nodeMultiply4(mat4 a, mat4 b) {
    return b * a;
}
// A matrix without an inverse has the identity for it.
PATINA_FN mat4 nodeInvert4(mat4 m) {
    float d = determinant(m);
    return d != 0.0f && isFinite(1.0f / d) ? inverse(m) : mat4(1.0f);
}
PATINA_FN mat4 nodeDivide4(mat4 a, mat4 b) {
    return nodeInvert4(b) * a;
}
PATINA_FN mat4 nodeTranspose4(mat4 m) {
    return transpose(m);
}
PATINA_FN float nodeDeterminant4(mat4 m) {
    return determinant(m);
}
PATINA_FN vec4 nodeExtractRow4(mat4 m, int index) {
    return m[min(max(index, 0), 3)];
}
PATINA_FN mat4 nodeIfGreater4(float a, float b, mat4 x, mat4 y) {
    return a > b ? x : y;
}
PATINA_FN mat4 nodeIfGreaterEq4(float a, float b, mat4 x, mat4 y) {
    return a >= b ? x : y;
}
PATINA_FN mat4 nodeIfEqual4(float a, float b, mat4 x, mat4 y) {
    return a == b ? x : y;
}
PATINA_FN mat4 nodeSwitch4(mat4 v0, mat4 v1, mat4 v2, mat4 v3, mat4 v4, mat4 v5, mat4 v6, mat4 v7,
                           mat4 v8, mat4 v9, float which) {
    float i = max(floor(which), 0.0f);
    if (i < 5.0f) return i < 1.0f ? v0 : i < 2.0f ? v1 : i < 3.0f ? v2 : i < 4.0f ? v3 : v4;
    if (i < 10.0f) return i < 6.0f ? v5 : i < 7.0f ? v6 : i < 8.0f ? v7 : i < 9.0f ? v8 : v9;
    return mat4(0.0f);
}

PATINA_FN mat3 nodeCreate3(vec3 a, vec3 b, vec3 c) {
    return mat3(a, b, c);
}
PATINA_FN mat4 nodeCreate4(vec3 a, vec3 b, vec3 c, vec3 d) {
    return mat4(vec4(a, 0.0f), vec4(b, 0.0f), vec4(c, 0.0f), vec4(d, 1.0f));
}
PATINA_FN mat4 nodeCreateFull4(vec4 a, vec4 b, vec4 c, vec4 d) {
    return mat4(a, b, c, d);
}

PATINA_FN vec2 nodeTransformPoint2(vec2 v, mat3 m) {
    return vec2(m * vec3(v, 1.0f));
}
PATINA_FN vec3 nodeTransform3(vec3 v, mat3 m) {
    return m * v;
}
PATINA_FN vec3 nodeTransformPoint3(vec3 v, mat4 m) {
    return vec3(m * vec4(v, 1.0f));
}
PATINA_FN vec4 nodeTransform4(vec4 v, mat4 m) {
    return m * v;
}

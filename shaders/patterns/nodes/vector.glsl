// SPDX-License-Identifier: Apache-2.0
// Nodes that look at a vector as a whole.

PATINA_FN_RARE float nodeDotProduct(vec4 a, vec4 b, NodeSize size) {
    float sum = 0.0f;
    for (int i = 0; i < size; ++i)
        sum += a[i] * b[i];
    return sum;
}
PATINA_FN float nodeMagnitude(vec4 v, NodeSize size) {
    return sqrt(nodeDotProduct(v, v, size));
}
PATINA_FN float nodeDistance(vec4 a, vec4 b, NodeSize size) {
    return nodeMagnitude(a - b, size);
}
PATINA_FN vec4 nodeNormalize(vec4 v, NodeSize size) {
    float l = nodeMagnitude(v, size);
    return l > 0.0f ? v / l : vec4(0.0f);
}
PATINA_FN vec3 nodeCrossProduct(vec3 a, vec3 b) {
    return cross(a, b);
}

PATINA_FN float nodeMaxComponent(vec4 v, NodeSize size) {
    float x = max(v.x, v.y);
    if (size > 2) x = max(x, v.z);
    return size > 3 ? max(x, v.w) : x;
}
PATINA_FN float nodeMinComponent(vec4 v, NodeSize size) {
    float x = min(v.x, v.y);
    if (size > 2) x = min(x, v.z);
    return size > 3 ? min(x, v.w) : x;
}

// As UsdTransform2d has its inputs.
PATINA_FN vec2 nodeTransform2d(vec2 uv, float rotation, vec2 scale, vec2 translation) {
    return patternTransform2d(uv, scale, rotation, translation);
}

// Colours keep their alpha.
PATINA_FN vec4 nodeLuminance(vec4 c, vec3 coefficients) {
    return vec4(vec3(patternLuminance(vec3(c), coefficients)), c.w);
}
PATINA_FN vec4 nodeRgbToHsv(vec4 c) {
    return vec4(patternRgbToHsv(vec3(c)), c.w);
}
PATINA_FN vec4 nodeHsvToRgb(vec4 c) {
    return vec4(patternHsvToRgb(vec3(c)), c.w);
}

// SPDX-License-Identifier: Apache-2.0
// Nodes that look at a vector as a whole.
#ifndef PATINA_NODE_ROWS

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

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

const char* const vectors = "vector2 vector3 vector4";
const char* const normalMapFrame =
    "vector3 in=0.5 0.5 1, $ scale=1, vector3 normal=@Nworld, vector3 tangent=@Tworld, "
    "vector3 bitangent=@Bworld";

const NodeRow rows[] = {
    {"ND_dotproduct_$", "dotproduct", "$ in1=0, $ in2=0", "float", PATINA_PATTERN(nodeDotProduct),
     Algebra::None, vectors},
    {"ND_magnitude_$", "magnitude", "$ in=0", "float", PATINA_PATTERN(nodeMagnitude), Algebra::None,
     vectors},
    {"ND_distance_$", "distance", "$ in1=0, $ in2=0", "float", PATINA_PATTERN(nodeDistance),
     Algebra::None, vectors},
    {"ND_normalize_$", "normalize", "$ in=0", "$", PATINA_PATTERN(nodeNormalize), Algebra::None,
     vectors},
    {"ND_crossproduct_vector3", "crossproduct", "vector3 in1=0, vector3 in2=0", "vector3",
     PATINA_PATTERN(nodeCrossProduct)},
    {"ND_rotate2d_vector2", "rotate2d", "vector2 in=0, float amount=0", "vector2",
     PATINA_PATTERN(patternRotate2d), Algebra::Rotate},
    {"ND_rotate3d_vector3", "rotate3d", "vector3 in=0, float amount=0, vector3 axis=0 1 0",
     "vector3", PATINA_PATTERN(patternRotate3d), Algebra::Rotate},
    {"ND_place2d_vector2", "place2d",
     "vector2 texcoord=0, vector2 pivot=0, vector2 scale=1, float rotate=0, vector2 offset=0, "
     "integer operationorder=0",
     "vector2", PATINA_PATTERN(patternPlace2d)},
    {"UsdTransform2d", "UsdTransform2d",
     "vector2 in=0, float rotation=0, vector2 scale=1, vector2 translation=0", "vector2 result",
     PATINA_PATTERN(nodeTransform2d)},
    {"ND_maxcomponent_$", "maxcomponent", "$ in=0", "float", PATINA_PATTERN(nodeMaxComponent),
     Algebra::None, tupleTypes},
    {"ND_mincomponent_$", "mincomponent", "$ in=0", "float", PATINA_PATTERN(nodeMinComponent),
     Algebra::None, tupleTypes},
    {"ND_luminance_$", "luminance", "$ in=0, color3 lumacoeffs=0.2722287 0.6740818 0.0536895", "$",
     PATINA_PATTERN(nodeLuminance), Algebra::None, "color3 color4"},
    {"ND_rgbtohsv_$", "rgbtohsv", "$ in=0", "$", PATINA_PATTERN(nodeRgbToHsv), Algebra::None,
     "color3 color4"},
    {"ND_hsvtorgb_$", "hsvtorgb", "$ in=0", "$", PATINA_PATTERN(nodeHsvToRgb), Algebra::None,
     "color3 color4"},
    {"ND_normalmap_$", "normalmap", normalMapFrame, "vector3", PATINA_PATTERN(patternNormalMap),
     Algebra::NormalMap, "float vector2"},
};

#endif

// SPDX-License-Identifier: Apache-2.0
// Placement of texture coordinates.

// angle: degrees, counter-clockwise for the coordinates (so a texture turns clockwise), as
// MaterialX rotate2d.
PATINA_FN vec2 patternRotate2d(vec2 v, float angle) {
    float a = angle * (PI / 180.0f);
    float s = sin(a);
    float c = cos(a);
    return vec2(c * v.x + s * v.y, c * v.y - s * v.x);
}

// order: 0 scales, rotates, translates; 1 translates, rotates, scales. MaterialX place2d.
PATINA_FN vec2 patternPlace2d(vec2 uv, vec2 pivot, vec2 scale, float angle, vec2 offset,
                              int order) {
    vec2 p = uv - pivot;
    vec2 inverse = vec2(select(1.0f / scale.x, 0.0f, scale.x != 0.0f),
                        select(1.0f / scale.y, 0.0f, scale.y != 0.0f));
    vec2 first = patternRotate2d(p * inverse, angle) - offset;
    vec2 second = patternRotate2d(p - offset, angle) * inverse;
    return select(first, second, order == 0) + pivot;
}

// UsdTransform2d of the UsdPreviewSurface specification: scale, then rotate counter-clockwise
// (degrees), then translate.
PATINA_FN vec2 patternTransform2d(vec2 uv, vec2 scale, float angle, vec2 translation) {
    return patternRotate2d(uv * scale, -angle) + translation;
}

// Rotates about an axis (the y axis when that has no length). angle: degrees; MaterialX multiplies
// rows by matrices, so it turns clockwise for somebody who looks against the axis.
PATINA_FN vec3 patternRotate3d(vec3 v, float angle, vec3 axis) {
    float l2 = dot(axis, axis);
    vec3 a = select(axis / sqrt(max(l2, 1e-30f)), vec3(0.0f, 1.0f, 0.0f), l2 > 1e-30f);
    float s = sin(angle * (PI / 180.0f));
    float c = cos(angle * (PI / 180.0f));
    return v * c + cross(v, a) * s + a * (dot(a, v) * (1.0f - c));
}

// Directions in which an image ends at 0 and 1: beyond there is a colour of its node's own.
const int IMAGE_ENDS_S = 1;
const int IMAGE_ENDS_T = 2;

// The share of an interval about u that lies within 0..1.
PATINA_FN float intervalCover(float u, float width) {
    float w = max(width, 1e-6f);
    return min(min(1.0f, 1.0f / w), clamp(min(u, 1.0f - u) / w + 0.5f, 0.0f, 1.0f));
}
// The share of a filter that lies on the image. ends: bits above; width: of the filter.
PATINA_FN float patternCover(vec2 uv, float width, int ends) {
    return ((ends & IMAGE_ENDS_S) != 0 ? intervalCover(uv.x, width) : 1.0f) *
           ((ends & IMAGE_ENDS_T) != 0 ? intervalCover(uv.y, width) : 1.0f);
}

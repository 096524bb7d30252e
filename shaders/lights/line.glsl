// SPDX-License-Identifier: Apache-2.0
// Lines that stand for thin cylinders. They shine by the sine of the angle off the line.

PATINA_FN float lineAcross(vec3 axis, vec3 direction) {
    float cosine = dot(direction, axis);
    return sqrt(max(0.0f, 1.0f - cosine * cosine));
}

// Equiangular along the line (Kulla and Fajardo 2012). middle: of the line; along: all of it; toLight: from the point
// to the sample; pdf: by length. False where there is nothing to see.
PATINA_FN bool lineSample(vec3 middle, vec3 along, vec3 point, float u, PATINA_OUT(vec3) toLight,
                          PATINA_OUT(float) pdf) {
    float l = length(along);
    toLight = middle - point;
    pdf = 0.0f;
    if (!(l > 0.0f)) return false;
    vec3 axis = along / l;
    vec3 v = point - middle;
    float foot = dot(v, axis);
    float away = max(length(v - foot * axis), 1e-4f * l);
    float a = (-0.5f * l - foot) / away;
    float b = (0.5f * l - foot) / away;
    float angle = atan(b - a, 1.0f + a * b);
    float turn = tan(u * angle);
    float x = (a + turn) / (1.0f - a * turn);
    toLight = middle + (foot + x * away) * axis - point;
    pdf = 1.0f / ((1.0f + x * x) * angle * away);
    return dot(toLight, toLight) > 0.0f && angle > 0.0f;
}

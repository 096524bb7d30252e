// SPDX-License-Identifier: Apache-2.0
// Disk lights, see ../shape.glsl.
const int SHAPE_DISK = 1;

PATINA_FN bool diskHit(vec3 o, vec3 d, PATINA_OUT(float) t, PATINA_OUT(vec3) q) {
    bool met = planeHit(o, d, t, q);
    return met && q.x * q.x + q.y * q.y <= 1.0f;
}

PATINA_FN vec3 diskPlace(vec2 u) {
    float r = sqrt(u.x);
    float a = TWO_PI * u.y;
    return vec3(r * cos(a), r * sin(a), 0.0f);
}

PATINA_FN float diskPlaceDensity(PATINA_IN(ShapeFrame) s, vec3 q) {
    return INV_PI / s.volume;
}

PATINA_FN vec3 diskNormal(PATINA_IN(ShapeFrame) s, vec3 q) {
    return s.axes[2];
}

PATINA_FN vec3 diskExtent(PATINA_IN(ShapeFrame) s) {
    vec3 a = abs(s.axes[0]);
    vec3 b = abs(s.axes[1]);
    return sqrt(a * a + b * b);
}

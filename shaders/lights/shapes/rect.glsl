// SPDX-License-Identifier: Apache-2.0
// Rect lights, see ../shape.glsl.
const int SHAPE_RECT = 0;

PATINA_FN bool rectHit(vec3 o, vec3 d, PATINA_OUT(float) t, PATINA_OUT(vec3) q) {
    bool met = planeHit(o, d, t, q);
    return met && abs(q.x) <= 0.5f && abs(q.y) <= 0.5f;
}

PATINA_FN vec3 rectPlace(vec2 u) {
    return vec3(u.x - 0.5f, u.y - 0.5f, 0.0f);
}

PATINA_FN float rectPlaceDensity(PATINA_IN(ShapeFrame) s, vec3 q) {
    return 1.0f / s.volume; // the third axis is a unit normal
}

PATINA_FN vec3 rectNormal(PATINA_IN(ShapeFrame) s, vec3 q) {
    return s.axes[2];
}

PATINA_FN vec3 rectExtent(PATINA_IN(ShapeFrame) s) {
    return 0.5f * (abs(s.axes[0]) + abs(s.axes[1]));
}

// Where a point of the rect lies on its image, whose left top corner is at (+x, +y) as the schema puts it.
PATINA_FN TableCell rectTexels(vec3 q, int width, int height) {
    TableCell c;
    float x = clamp((0.5f - q.x) * float(width) - 0.5f, 0.0f, float(width - 1));
    float y = clamp((0.5f - q.y) * float(height) - 0.5f, 0.0f, float(height - 1));
    int i = int(x);
    int k = int(y);
    int next = min(i + 1, width - 1);
    c.low = k * width + i;
    c.lowNext = k * width + next;
    c.high = min(k + 1, height - 1) * width + i;
    c.highNext = min(k + 1, height - 1) * width + next;
    c.across = x - float(i);
    c.along = y - float(k);
    return c;
}

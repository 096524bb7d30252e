// SPDX-License-Identifier: Apache-2.0
// Ramps of MaterialX 1.39.

// Where a point of the unit square lies on a ramp. kind: 0 along u, 1 around the middle, 2 and 3
// from the middle outwards, as a circle and as a square.
PATINA_FN float patternRampPosition(vec2 uv, int kind) {
    vec2 d = uv - vec2(0.5f, 0.5f);
    float around = atan(d.x, d.y) / 6.28319f + 0.5f;
    float circle = sqrt(dot(d, d)) * 1.414f;
    float box = 2.0f * max(abs(d.x), abs(d.y));
    float outwards = select(circle, box, kind == 2);
    return select(uv.x, select(around, outwards, kind == 1), kind == 0);
}

// How far x is from one stop to the next. interpolation: 0 linear, 1 smooth, 2 step.
PATINA_FN float patternRampBlend(float x, float low, float high, int interpolation) {
    float range = high - low;
    float t = select(clamp((x - low) / select(range, 1.0f, range != 0.0f), 0.0f, 1.0f),
                     select(1.0f, 0.0f, x >= high), range != 0.0f);
    float eased = t * t * (3.0f - 2.0f * t);
    float stepped = select(1.0f, 0.0f, x >= high);
    return select(t, select(eased, stepped, interpolation == 1), interpolation == 0);
}

// One channel of two colours between left and right, top and bottom; v counts upwards.
PATINA_FN float patternRamp4(float tl, float tr, float bl, float br, vec2 uv) {
    float s = clamp(uv.x, 0.0f, 1.0f);
    return mix(mix(bl, br, s), mix(tl, tr, s), clamp(uv.y, 0.0f, 1.0f));
}

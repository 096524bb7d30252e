// SPDX-License-Identifier: Apache-2.0
// Colour arithmetic of pattern nodes. Colours are linear.

// coefficients: of the working space's luminance, Rec.709 by default.
PATINA_FN float patternLuminance(vec3 color, vec3 coefficients) {
    return dot(color, coefficients);
}

// Hue, saturation, value; hue in [0, 1).
PATINA_FN vec3 patternRgbToHsv(vec3 c) {
    float high = max(c.x, max(c.y, c.z));
    float low = min(c.x, min(c.y, c.z));
    float range = high - low;
    float safe = select(range, 1.0f, range > 0.0f);
    float h = select((c.y - c.z) / safe, 2.0f + (c.z - c.x) / safe, c.x == high);
    h = select(h, 4.0f + (c.x - c.y) / safe, c.x == high || c.y == high);
    h = h * (1.0f / 6.0f);
    h = select(h - floor(h), 0.0f, range > 0.0f);
    float s = select(range / select(high, 1.0f, high > 0.0f), 0.0f, high > 0.0f);
    return vec3(h, s, high);
}

PATINA_FN vec3 patternHsvToRgb(vec3 c) {
    float h = (c.x - floor(c.x)) * 6.0f;
    vec3 pure =
        vec3(clamp(abs(h - 3.0f) - 1.0f, 0.0f, 1.0f), clamp(2.0f - abs(h - 2.0f), 0.0f, 1.0f),
             clamp(2.0f - abs(h - 4.0f), 0.0f, 1.0f));
    return mix(vec3(1.0f), pure, c.y) * c.z;
}

// amount: added to the hue, times saturation, times value.
PATINA_FN vec3 patternHsvAdjust(vec3 c, vec3 amount) {
    vec3 hsv = patternRgbToHsv(c);
    return patternHsvToRgb(vec3(hsv.x + amount.x, hsv.y * amount.y, hsv.z * amount.z));
}

// amount: 0 grey, 1 as it is.
PATINA_FN vec3 patternSaturate(vec3 c, float amount, vec3 coefficients) {
    return mix(vec3(dot(c, coefficients)), c, amount);
}

// The power of the amount, with the sign kept; 0 where it has no finite value.
PATINA_FN float patternSafePower(float x, float e) {
    float p = powSchlick(abs(x), e);
    p = select(p, 0.0f, p <= 3.4e38f);
    return select(-p, p, x < 0.0f);
}

// One channel to [0, 1] by low and high, through a gamma, to outLow and outHigh.
PATINA_FN float patternRange(float x, float low, float high, float gamma, float outLow,
                             float outHigh) {
    float range = high - low;
    float t = select((x - low) / select(range, 1.0f, range != 0.0f), 0.0f, range != 0.0f);
    float bent = patternSafePower(t, 1.0f / select(gamma, 1.0f, gamma != 0.0f));
    return outLow + bent * (outHigh - outLow);
}

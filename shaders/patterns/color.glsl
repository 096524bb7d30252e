// Colour arithmetic of pattern nodes. Colours are linear.

// coefficients: of the working space's luminance, Rec.709 by default.
PATINA_FN float patternLuminance(vec3 color, vec3 coefficients) {
    return dot(color, coefficients);
}

// One channel of the sRGB transfer function (IEC 61966-2-1), to linear.
PATINA_FN float srgbToLinear(float x) {
    float low = x * (1.0f / 12.92f);
    float high = pow(max(x + 0.055f, 0.0f) * (1.0f / 1.055f), 2.4f);
    return select(low, high, x <= 0.04045f);
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
    vec3 pure = vec3(clamp(abs(h - 3.0f) - 1.0f, 0.0f, 1.0f),
                     clamp(2.0f - abs(h - 2.0f), 0.0f, 1.0f),
                     clamp(2.0f - abs(h - 4.0f), 0.0f, 1.0f));
    return mix(vec3(1.0f), pure, c.y) * c.z;
}

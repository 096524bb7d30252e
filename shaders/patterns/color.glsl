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

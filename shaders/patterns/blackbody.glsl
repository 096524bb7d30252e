// SPDX-License-Identifier: Apache-2.0
// Colour of heated bodies.

// Linear Rec.709 of luminance 1. temperature: kelvin, 800 to 25000. Chromaticity after Kang et al.
// 2002, "Design of advanced color temperature control system for HDTV applications"; the cubic for
// x is used below its range (1667 K) too, where it still runs well.
PATINA_FN vec3 patternBlackbody(float temperature) {
    float kelvin = clamp(temperature, 800.0f, 25000.0f);
    float t = 1000.0f / kelvin;
    float warm = 0.179910f + t * (0.8776956f + t * (-0.2343580f - 0.2661239f * t));
    float cold = 0.240390f + t * (0.2226347f + t * (2.1070379f - 3.0258469f * t));
    float x = select(warm, cold, kelvin < 4000.0f);
    float red = -0.20219683f + x * (2.18555832f + x * (-1.34811020f - 1.1063814f * x));
    float orange = -0.16748867f + x * (2.09137015f + x * (-1.37418593f - 0.9549476f * x));
    float white = -0.37001483f + x * (3.75112997f + x * (-5.87338670f + 3.0817580f * x));
    float y = select(red, select(orange, white, kelvin < 4000.0f), kelvin < 2222.0f);
    float safe = max(y, 1e-6f);
    float cx = x / safe;
    float cz = (1.0f - x - y) / safe;
    vec3 rgb = vec3(3.2406f * cx - 1.5372f - 0.4986f * cz, -0.9689f * cx + 1.8758f + 0.0415f * cz,
                    0.0557f * cx - 0.2040f + 1.0570f * cz);
    return max(rgb, vec3(0.0f));
}

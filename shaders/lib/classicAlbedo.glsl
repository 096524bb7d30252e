// SPDX-License-Identifier: Apache-2.0
// Directional albedos of the classic lobes in white, from tables that shaders/bake writes behind
// that of sheen: one plane per lobe over (mu, alpha) in the coordinates of albedoTable.glsl, and
// the moments of the V-cavity lobe in the layout of the moment table.

const int CLASSIC_PHONG = 0;
const int CLASSIC_BLINN_PHONG = 1;
const int CLASSIC_WARD_BOUNDED = 2;
const int CLASSIC_WARD_EXACT = 3;

PATINA_FN float classicAlbedo(int plane, float mu, float alpha) {
    float tm = tableMuCoord(clamp(mu, 0.0f, 1.0f), alpha);
    float ta = tableAlphaCoord(alpha);
    int row = plane * CLASSIC_ALPHA + tableCell(ta, CLASSIC_ALPHA);
    int i = CLASSIC_TABLE + row * CLASSIC_MU + tableCell(tm, CLASSIC_MU);
    float fm = tableFraction(tm, CLASSIC_MU);
    float a = mix(albedoTableFetch(i), albedoTableFetch(i + 1), fm);
    float b = mix(albedoTableFetch(i + CLASSIC_MU), albedoTableFetch(i + CLASSIC_MU + 1), fm);
    return mix(a, b, tableFraction(ta, CLASSIC_ALPHA));
}

// The share that anisotropy adds to a form of Ward's lobe (CLASSIC_WARD_*) over the isotropic one that stands
// in (microfacetAlphaSeen), in the layout of anisotropicAlbedo.glsl.
PATINA_FN_RARE float wardTurned(int plane, vec3 wo, vec2 alpha) {
    MicrofacetPlace p = microfacetPlace(wo, alpha, NDF_GGX);
    int i = WARD_TABLE + (plane - CLASSIC_WARD_BOUNDED) * WARD_SIZE + p.turnedBase;
    float e = 0.0f;
    for (int k = 0; k < 16; ++k)
        e += turnedWeight(k, p.turnedAt) * albedoTableFetch(i + turnedCorner(k));
    return e;
}

// The alpha whose Gaussian is as wide as the cosine power `exponent`, and back.
PATINA_FN float phongAlpha(float exponent) {
    return sqrt(2.0f / (exponent + 2.0f));
}

PATINA_FN float phongExponent(float alpha) {
    return 2.0f / (alpha * alpha) - 2.0f;
}

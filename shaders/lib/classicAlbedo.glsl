// SPDX-License-Identifier: Apache-2.0
// Directional albedos of the classic lobes in white, from tables that shaders/bake writes behind
// that of sheen: one plane per lobe over (mu, alpha) in the coordinates of albedoTable.glsl, and
// the moments of the V-cavity lobe in the layout of the moment table.

const int CLASSIC_PHONG = 0;
const int CLASSIC_BLINN_PHONG = 1;
const int CLASSIC_WARD_BOUNDED = 2;
const int CLASSIC_WARD_EXACT = 3;

// Where mu lies between two nodes of the table. Smooth lobes reflect mu (Phong) and mu^2 (Blinn-Phong), and
// cells are wide there: the fraction is that of mu or of mu^2, so that these are met between nodes too.
PATINA_FN float classicFraction(int plane, float mu, int cell, float alpha) {
    float low = tableMuAt(float(cell) / float(CLASSIC_MU - 1), alpha);
    float high = tableMuAt(float(cell + 1) / float(CLASSIC_MU - 1), alpha);
    float f = (mu - low) / max(high - low, TINY);
    if (plane == CLASSIC_BLINN_PHONG) f *= (mu + low) / max(high + low, TINY);
    return clamp(f, 0.0f, 1.0f);
}

PATINA_FN float classicAlbedo(int plane, float mu, float alpha) {
    float z = clamp(mu, 0.0f, 1.0f);
    float tm = tableMuCoord(z, alpha);
    float ta = tableAlphaCoord(alpha);
    int row = plane * CLASSIC_ALPHA + tableCell(ta, CLASSIC_ALPHA);
    int cell = tableCell(tm, CLASSIC_MU);
    int i = CLASSIC_TABLE + row * CLASSIC_MU + cell;
    float fm = tableFraction(tm, CLASSIC_MU);
    if (plane <= CLASSIC_BLINN_PHONG) fm = classicFraction(plane, z, cell, alpha);
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

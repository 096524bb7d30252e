// SPDX-License-Identifier: Apache-2.0
// Directional albedo of the Conty-Kulla sheen lobe before it is bounded, from a table that
// shaders/bake writes behind those of albedoTable.glsl. Both axes crowd where the albedo is steep:
// at grazing angles and at small roughness.

const int SHEEN_MU = 32;
const int SHEEN_ROUGHNESS = 32;
const int SHEEN_TABLE = 2 * MICROFACET_SIZE;

PATINA_FN float sheenMuAt(float t) {
    return t * t;
}

PATINA_FN float sheenRoughnessAt(float t) {
    float r0 = sqrt(SHEEN_ROUGHNESS_MIN);
    return sqr(r0 + t * (1.0f - r0));
}

// mu in [0, 1], roughness in [SHEEN_ROUGHNESS_MIN, 1].
PATINA_FN float sheenAlbedoTable(float mu, float roughness) {
    float r0 = sqrt(SHEEN_ROUGHNESS_MIN);
    float tm = safeSqrt(mu);
    float tr = (sqrt(roughness) - r0) / (1.0f - r0);
    int i = SHEEN_TABLE + tableCell(tr, SHEEN_ROUGHNESS) * SHEEN_MU + tableCell(tm, SHEEN_MU);
    float fm = tableFraction(tm, SHEEN_MU);
    float a = mix(albedoTableFetch(i), albedoTableFetch(i + 1), fm);
    float b = mix(albedoTableFetch(i + SHEEN_MU), albedoTableFetch(i + SHEEN_MU + 1), fm);
    return mix(a, b, tableFraction(tr, SHEEN_ROUGHNESS));
}

// SPDX-License-Identifier: Apache-2.0
// The choice point sheen: how the light is found that the Conty-Kulla lobe reflects in total, before
// it is bounded. The lobe is divided by it, and layers take it from their base.

const int SHEEN_TABLED = 0;     // sheenAlbedo.glsl
const int SHEEN_QUADRATURE = 1; // midpoints: truth, within 2e-4

const int SHEEN_HEIGHTS = 64;  // evenly spaced in the root of the cosine
const int SHEEN_AZIMUTHS = 32; // over half of the circle

PATINA_FN_RARE float sheenQuadrature(float mu, float roughness) {
    vec3 wo = vec3(safeSqrt(1.0f - mu * mu), 0.0f, mu);
    float sum = 0.0f;
    for (int i = 0; i < SHEEN_HEIGHTS; ++i) {
        float t = (float(i) + 0.5f) / float(SHEEN_HEIGHTS);
        float z = t * t;
        float r = safeSqrt(1.0f - z * z);
        for (int j = 0; j < SHEEN_AZIMUTHS; ++j) {
            float phi = PI * (float(j) + 0.5f) / float(SHEEN_AZIMUTHS);
            sum += t * sheenContyKulla(roughness, wo, vec3(r * cos(phi), r * sin(phi), z)).x;
        }
    }
    return sum * 2.0f * TWO_PI / float(SHEEN_HEIGHTS * SHEEN_AZIMUTHS);
}

// mu in [0, 1], roughness in [SHEEN_ROUGHNESS_MIN, 1].
PATINA_FN float sheenReflects(float mu, float roughness, int method) {
    if (method == SHEEN_QUADRATURE) return sheenQuadrature(mu, roughness);
    return sheenAlbedoTable(mu, roughness);
}

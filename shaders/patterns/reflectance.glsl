// SPDX-License-Identifier: Apache-2.0
// Helpers that turn artistic parameters into those of lobes.

// MaterialX roughness_anisotropy: GGX alpha along x and y from roughness and anisotropy in [0, 1].
PATINA_FN vec2 patternRoughnessAnisotropy(float roughness, float anisotropy) {
    float a = clamp(roughness * roughness, 1e-8f, 1.0f);
    float aspect = sqrt(1.0f - clamp(anisotropy, 0.0f, 0.98f));
    vec2 stretched = vec2(min(a / aspect, 1.0f), a * aspect);
    return select(stretched, vec2(a, a), anisotropy > 0.0f);
}

// MaterialX roughness_dual: squares both; a negative y means "as x".
PATINA_FN vec2 patternRoughnessDual(vec2 roughness) {
    float y = select(roughness.x, roughness.y, roughness.y < 0.0f);
    return vec2(clamp(roughness.x * roughness.x, 1e-8f, 1.0f), clamp(y * y, 1e-8f, 1.0f));
}

// Gulbrandsen 2014, "Artist friendly metallic Fresnel": ior (n) of one channel from the
// reflectance at normal incidence and the tint of the edge.
PATINA_FN float patternArtisticIor(float reflectivity, float edge) {
    float r = clamp(reflectivity, 0.0f, 0.99f);
    float root = sqrt(r);
    float low = (1.0f - r) / (1.0f + r);
    float high = (1.0f + root) / (1.0f - root);
    return mix(high, low, clamp(edge, 0.0f, 1.0f));
}

// The extinction (k) that belongs to it.
PATINA_FN float patternArtisticExtinction(float reflectivity, float n) {
    float r = clamp(reflectivity, 0.0f, 0.99f);
    float k2 = ((n + 1.0f) * (n + 1.0f) * r - (n - 1.0f) * (n - 1.0f)) / (1.0f - r);
    return sqrt(max(k2, 0.0f));
}

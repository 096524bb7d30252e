// SPDX-License-Identifier: Apache-2.0
// The Conty-Kulla sheen lobe as it is published, see lobes/sheen.glsl.

// Share of the samples that the half vector makes; the rest is uniform. Broad lobes need none.
PATINA_FN float sheenHalfShare(float roughness) {
    return 0.5f * sqr(1.0f - roughness);
}

// The Conty-Kulla lobe as it is published: f |cos wi|, and the density of the sampler.
PATINA_FN vec2 sheenContyKulla(float roughness, vec3 wo, vec3 wi) {
    float e = 1.0f / roughness;
    vec3 h = wo + wi;
    float h2 = max(dot(h, h), TINY);
    float sine2 = clamp((h.x * h.x + h.y * h.y) / h2, 0.0f, 1.0f);
    float d = (2.0f + e) * 0.5f * INV_PI * powSchlick(sine2, 0.5f * e);
    float sum = wo.z + wi.z;
    float value = 0.25f * d * wi.z / max(sum - wo.z * wi.z, TINY);
    // D h.z / (4 o.h) with o.h = |h| / 2.
    float viaHalf = 0.5f * d * sum / h2;
    return vec2(value, mix(0.5f * INV_PI, viaHalf, sheenHalfShare(roughness)));
}

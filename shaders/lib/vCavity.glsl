// SPDX-License-Identifier: Apache-2.0
// Beckmann facets with the V-cavity masking of Torrance and Sparrow 1967, isotropic, and visible
// normal sampling for them (Heitz and d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using
// the Distribution of Visible Normals", supplement): facets come in pairs that lean to either side,
// and the one that wo sees more of is the likelier.

// Density of facet normals per solid angle and projected area (Beckmann and Spizzichino 1963).
// tan2: squared tangent of the facet's angle, cos4: its cosine to the fourth, alpha2: alpha^2.
PATINA_FN float beckmannD(float tan2, float cos4, float alpha2) {
    return exp2(-1.44269504f * tan2 / alpha2) * INV_PI / (alpha2 * max(cos4, TINY));
}

// A facet normal with density D(m) m.z. u.x: slope, u.y: azimuth.
PATINA_FN vec3 beckmannSample(float alpha, vec2 u) {
    float r = alpha * sqrt(max(-0.693147181f * log2(1.0f - u.x), 0.0f));
    float phi = TWO_PI * u.y;
    return normalize(vec3(r * cos(phi), r * sin(phi), 1.0f));
}

// G1(o) / o.z for a facet with cosine mz and o.m = om above 0.
PATINA_FN float vCavityVisible(float oz, float om, float mz) {
    return 1.0f / max(max(oz, 0.5f * om / max(mz, TINY)), TINY);
}

// min(G1(o), G1(i)) / o.z: G of Cook and Torrance over o.z.
PATINA_FN float vCavityBoth(float oz, float iz, float om, float mz) {
    return min(min(1.0f, 2.0f * mz * iz / max(om, TINY)) / max(oz, TINY),
               2.0f * mz / max(om, TINY));
}

// The facet or its partner on the other side of the cavity.
PATINA_FN vec3 vCavityChoose(vec3 wo, vec3 m, float u) {
    vec3 other = vec3(-m.x, -m.y, m.z);
    float a = max(dot(wo, m), 0.0f);
    float b = max(dot(wo, other), 0.0f);
    return select(other, m, u * (a + b) >= a);
}

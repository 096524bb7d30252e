// SPDX-License-Identifier: Apache-2.0
// Distant lights: a cone of directions. versine: 1 - cos of half its angle, which stays precise where it is narrow.

PATINA_FN float distantPdf(float versine) {
    return 1.0f / (2.0f * PI * versine);
}

// Even over the cone. b: a frame about the direction to the light
PATINA_FN vec3 distantSample(LightBasis b, float versine, vec2 u) {
    float h = u.x * versine;
    float sine = sqrt(max(0.0f, h * (2.0f - h)));
    float phi = 2.0f * PI * u.y;
    return normalize((1.0f - h) * b.z + sine * (cos(phi) * b.x + sin(phi) * b.y));
}

PATINA_FN bool distantHit(vec3 toLight, float versine, vec3 direction) {
    vec3 d = direction - toLight; // of length sqrt(2 (1 - cos)), which keeps small angles precise
    return 0.5f * dot(d, d) <= versine;
}

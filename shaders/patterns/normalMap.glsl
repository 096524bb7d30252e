// SPDX-License-Identifier: Apache-2.0
// Tangent space normal maps.

// encoded: normal in [0, 1] per channel, 0.5 being 0. scale: strength along tangent and bitangent.
// n, t, b: frame that the map lives in. A black texel (no map there) gives n. Returns a unit
// vector, n when the result would vanish.
PATINA_FN vec3 patternNormalMap(vec3 encoded, vec2 scale, vec3 n, vec3 t, vec3 b) {
    vec3 v = encoded * 2.0f - vec3(1.0f);
    v = select(vec3(0.0f, 0.0f, 1.0f), v, dot(encoded, encoded) == 0.0f);
    vec3 m = t * (v.x * scale.x) + b * (v.y * scale.y) + n * v.z;
    float l2 = dot(m, m);
    return select(m / sqrt(max(l2, TINY)), n, l2 > 1e-12f);
}

// SPDX-License-Identifier: Apache-2.0
// Metal flakes of MaterialX 1.39 (flake2d, flake3d): randomly turned cubes in the cells of a
// lattice; where several overlap, the one of highest priority shows. Needs patterns/noise.glsl.

// id: of the flake, 0 for none. random: a number per flake. presence: its priority, 0 for none.
struct FlakeHit {
    int id;
    float random;
    float presence;
    vec3 normal;
};

// Arvo 1992, "Fast random rotation matrices" (Graphics Gems III): p turned by the rotation that
// belongs to three random numbers.
PATINA_FN vec3 flakeTurn(vec3 p, vec3 u) {
    float theta = TWO_PI * u.x;
    float phi = TWO_PI * u.y;
    float z = u.z * 2.0f;
    vec3 v = vec3(sin(phi) * sqrt(z), cos(phi) * sqrt(z), sqrt(max(2.0f - z, 0.0f)));
    float s = sin(theta);
    float c = cos(theta);
    vec2 w = vec2(v.x * c - v.y * s, v.x * s + v.y * c);
    // Columns of the matrix.
    vec3 m0 = vec3(v.x * w.x - c, v.x * w.y - s, v.x * v.z);
    vec3 m1 = vec3(v.y * w.x + s, v.y * w.y - c, v.y * v.z);
    vec3 m2 = vec3(v.z * w.x, v.z * w.y, 1.0f - z);
    return m0 * p.x + m1 * p.y + m2 * p.z;
}

// The chance that a cell holds a flake, for a share of the surface that flakes shall cover: a
// rational function fitted to that, as MaterialX has it.
PATINA_FN float flakeChance(float coverage) {
    float x = clamp(coverage, 0.0f, 1.0f);
    return x * (26.39663835f - 26.19771808f * x) /
           (118.45082288f + x * (-101.42634862f + x * (-102.35069432f + x * 85.53857017f)));
}

// size: of a cell. roughness: spread of the flakes' normals (GGX, alpha is its square).
// n, t, b: the frame that flakes lie in.
PATINA_FN FlakeHit patternFlake(float size, float roughness, float coverage, vec3 position, vec3 n,
                                vec3 t, vec3 b) {
    float chance = flakeChance(coverage);
    float reach = 0.8660254f; // from a flake's middle to its sides, in cells
    vec3 p = position / select(size, 1.0f, abs(size) > 1e-12f);
    vec3 base = vec3(floor(p.x), floor(p.y), floor(p.z));
    float best = 0.0f;
    vec3 cell = vec3(0.0f);
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                vec3 at = base + vec3(float(x), float(y), float(z));
                vec3 q = p - at - vec3(0.5f);
                if (dot(q, q) >= 3.0f * reach * reach) continue;
                if (noiseCell3(at) > chance) continue;
                int i = noiseCell(at.x);
                int j = noiseCell(at.y);
                int k = noiseCell(at.z);
                float priority = noiseUnit(noiseHash4(i, j, k, 3));
                if (priority < best) continue;
                vec3 r = abs(flakeTurn(q, noiseCellTriple3(at)));
                if (max(r.x, max(r.y, r.z)) <= reach) {
                    best = priority;
                    cell = at;
                }
            }
    FlakeHit hit;
    hit.id = 0;
    hit.random = 0.0f;
    hit.presence = 0.0f;
    hit.normal = n;
    if (best <= 0.0f) return hit;

    int i = noiseCell(cell.x);
    int j = noiseCell(cell.y);
    int k = noiseCell(cell.z);
    vec3 u = vec3(noiseUnit(noiseHash5(i, j, k, 2, 0)), noiseUnit(noiseHash5(i, j, k, 2, 1)),
                  noiseUnit(noiseHash5(i, j, k, 2, 2)));
    float phi = TWO_PI * u.x;
    float tangent = roughness * roughness * sqrt(u.y / max(1.0f - u.y, 1e-7f));
    float cosine = 1.0f / sqrt(1.0f + tangent * tangent);
    float sine = tangent * cosine;
    vec3 m = t * (cos(phi) * sine) + b * (sin(phi) * sine) + n * cosine;
    float l2 = dot(m, m);
    hit.id = int(u.z * 16777215.0f);
    hit.random = u.z;
    hit.presence = best;
    hit.normal = select(m / sqrt(max(l2, 1e-30f)), n, l2 > 1e-12f);
    return hit;
}

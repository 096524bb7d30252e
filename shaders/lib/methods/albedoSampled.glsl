// SPDX-License-Identifier: Apache-2.0
// Directional albedo by adding up facets: visible normals over a stratified square, shifted by a
// hash of view and roughness, so that neighbours err independently; or, as truth, a lattice that
// crowds where facets of GGX lean far, since that tail decides what is lost at small roughness.

const int ALBEDO_QUADRATURE_ROWS = 48;
const int ALBEDO_QUADRATURE_NORMALS = ALBEDO_QUADRATURE_ROWS * ALBEDO_QUADRATURE_ROWS;

// Facet j of `count` (a square number, or ALBEDO_QUADRATURE_NORMALS): (cosine between view and
// facet, its share of the reflected light).
PATINA_FN vec2 sampledMicrofacet(vec3 wo, vec2 alpha, int ndf, int count, int j) {
    bool lattice = count == ALBEDO_QUADRATURE_NORMALS;
    int n = select(ALBEDO_QUADRATURE_ROWS, select(8, 4, count == 64), lattice);
    int row = j / n;
    int column = j - row * n;
    float seed = wo.z * 91.3458f + alpha.x * 47.9898f + alpha.y * 13.7f;
    float x = facetFract(sin(seed) * 437.585f);
    float y = facetFract(sin(seed + 1.7f) * 437.585f);
    float turn = facetFract((float(column) + 0.5f) * 0.618033989f);
    x = select(0.5f, x, lattice);
    y = select(turn, y, lattice);
    float v = (float(row) + y) / float(n);
    bool crowds = lattice && ndf == NDF_GGX;
    vec2 u = vec2((float(column) + x) / float(n), select(1.0f - v * v * v, v, crowds));
    vec3 m = microfacetSampleVisible(wo, alpha, u, ndf);
    float c = clamp(dot(wo, m), 0.0f, 1.0f);
    vec3 wi = m * (2.0f * c) - wo;
    float left = microfacetG2OverG1(wo.z, microfacetLength(wo, alpha, ndf), max(wi.z, 0.0f),
                                    microfacetLength(wi, alpha, ndf));
    float weight = select(3.0f * v * v, 1.0f, crowds) / float(count);
    return vec2(c, select(weight * left, 0.0f, wi.z > 0.0f));
}

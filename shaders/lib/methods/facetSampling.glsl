// The choice point facetSampling: which facets are drawn.

const int FACETS_VISIBLE = 0; // what wo sees (facetSampleVisible)
const int FACETS_BOUNDED = 1; // of those, what can reflect upwards
const int FACETS_ALL = 2;     // all, by their density

// Bounded visible normals of GGX (Eto and Tokuyoshi 2023, "Bounded VNDF Sampling for Smith-GGX
// Reflections"): the cap that facets are drawn from ends lower by this factor.
PATINA_FN float facetBound(vec3 wo, vec2 alpha) {
    float a2 = sqr(min(alpha.x, alpha.y));
    float s2 = sqr(1.0f + sqrt(wo.x * wo.x + wo.y * wo.y));
    return (1.0f - a2) * s2 / (s2 + a2 * wo.z * wo.z);
}

PATINA_FN vec3 facetSampleBounded(vec3 wo, vec2 alpha, vec2 u) {
    vec3 o = normalize(vec3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    float bound = facetBound(wo, alpha) * o.z;
    float z = (1.0f - u.y) * (1.0f + bound) - bound;
    float r = safeSqrt(1.0f - z * z);
    float phi = TWO_PI * u.x;
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + o;
    return normalize(vec3(alpha.x * h.x, alpha.y * h.y, max(h.z, NORMAL_Z_MIN)));
}

PATINA_FN vec3 facetSampleAll(vec2 alpha, vec2 u, int facets) {
    float left = max(1.0f - u.y, TINY);
    float ggx = sqrt(u.y / left);
    float beckmann = sqrt(-log2(left) * 0.693147181f);
    float r = select(beckmann, ggx, facets == FACETS_BECKMANN);
    float phi = TWO_PI * u.x;
    return normalize(vec3(alpha.x * r * cos(phi), alpha.y * r * sin(phi), 1.0f));
}

// What a method can do: bounds are those of reflection on GGX.
PATINA_FN int facetSampling(int sampling, int facets, int mode) {
    bool can = sampling != FACETS_BOUNDED || (facets == FACETS_GGX && mode == SCATTER_R);
    return select(sampling, FACETS_VISIBLE, can);
}

// Draws a facet for wo above the surface. Facets that wo cannot see come out too, of FACETS_ALL.
PATINA_FN vec3 facetSample(vec3 wo, vec2 alpha, vec2 u, int facets, int sampling) {
    if (sampling == FACETS_BOUNDED) return facetSampleBounded(wo, alpha, u);
    if (sampling == FACETS_ALL) return facetSampleAll(alpha, u, facets);
    return facetSampleVisible(wo, alpha, u, facets);
}

// Density over that of the visible normals. mz: z of the facet, c: wo.m.
PATINA_FN float facetDensity(vec3 wo, vec2 alpha, float mz, float c, int facets, int sampling) {
    if (sampling == FACETS_VISIBLE) return 1.0f;
    float length = facetLength(wo, alpha, facets);
    float visible = wo.z + length;
    if (sampling == FACETS_ALL) return 0.5f * mz * visible / max(c, TINY);
    return visible / max(facetBound(wo, alpha) * wo.z + length, TINY);
}

// SPDX-License-Identifier: Apache-2.0
// Back-scattering fibres over a base: MaterialX sheen_bsdf. Mode conty_kulla is the microfacet
// model of Conty and Kulla 2017 ("Production Friendly Microfacet Sheen BRDF", eq. 2) without
// Fresnel and masking, over the smooth denominator of Neubelt and Pettineo 2013 ("Crafting a
// Next-Gen Material Pipeline for The Order: 1886"). At small roughness it reflects more than it
// gets at grazing angles; it is divided by its albedo there, so that a layer can never gain energy.
// Reciprocal only where that albedo is below 1. Mode zeltner is the linearly transformed cosine of
// Zeltner, Burley and Chiang 2022 ("Practical Multiple-Scattering Sheen Using Linearly Transformed
// Cosines") with the rational fits that MaterialX publishes for it. Not reciprocal. One-sided.

const int SHEEN_CONTY_KULLA = 0;
const int SHEEN_ZELTNER = 1;

struct SheenLobe {
    vec3 color;
    float roughness;
    int mode;
    int albedo; // SHEEN_TABLED and others, of mode conty_kulla
};

// color: factor on the lobe; what a layer lets through does not hang on it. roughness: clamped to
// [SHEEN_ROUGHNESS_MIN, 1].
PATINA_FN SheenLobe sheenSetup(vec3 color, float roughness, int mode) {
    SheenLobe l;
    l.color = lobeColor(color);
    l.roughness = clamp(roughness, SHEEN_ROUGHNESS_MIN, 1.0f);
    l.mode = mode;
    l.albedo = SHEEN_TABLED;
    return l;
}

// The lobe with another method to find the albedo by.
PATINA_FN SheenLobe sheenMethods(SheenLobe l, int albedo) {
    l.albedo = albedo;
    return l;
}

// Gaussian fit of the directional albedo over the cosine x, roughness y.
PATINA_FN float sheenZeltnerAlbedo(float x, float y) {
    float s = y * (0.0206607f + 1.58491f * y) / (0.0379424f + y * (1.32227f + y));
    float m =
        y * (-0.193854f + y * (-1.14885f + y * (1.7932f - 0.95943f * y * y))) / (0.046391f + y);
    float o =
        y * (0.000654023f + (-0.0207818f + 0.119681f * y) * y) / (1.26264f + y * (-1.92021f + y));
    // exp(-t^2 / 2) / (s sqrt(2 PI)), with log2(e) / 2.
    float t = (x - m) / s;
    return clamp(exp2(-0.721347520f * t * t) * 0.398942280f / s + o, 0.0f, 1.0f);
}

// The inverse transform of the cosine lobe, in the plane of wo: x = a, y = b of rows (a 0 b), (0 a
// 0), (0 0 1).
PATINA_FN vec2 sheenZeltnerTransform(float x, float y) {
    float a = (2.58126f * x + 0.813703f * y) * y / (1.0f + 0.310327f * x * x + 2.60994f * x * y);
    float b = safeSqrt(1.0f - x) * (y - 1.0f) * y * y * y /
              (0.0000254053f + 1.71228f * x - 1.71506f * x * y + 1.34174f * y * y);
    return vec2(a, b);
}

// Unit vector along the projection of wo, x where there is none.
PATINA_FN vec2 sheenAzimuth(vec3 wo) {
    float r2 = wo.x * wo.x + wo.y * wo.y;
    float s = 1.0f / sqrt(max(r2, TINY));
    return select(vec2(1.0f, 0.0f), vec2(wo.x * s, wo.y * s), r2 <= TINY);
}

// Albedo without colour: what a layer takes from its base.
PATINA_FN float sheenWhiteAlbedo(SheenLobe l, float mu) {
    float x = clamp(mu, 0.0f, 1.0f);
    if (l.mode == SHEEN_ZELTNER) return sheenZeltnerAlbedo(x, l.roughness);
    return min(sheenReflects(x, l.roughness, l.albedo), 1.0f);
}

PATINA_FN LobeEval sheenEval(SheenLobe l, vec3 wo, vec3 wi) {
    if (wo.z < 0.0f || wi.z <= 0.0f) return lobeEvalNone();
    LobeEval e;
    if (l.mode == SHEEN_ZELTNER) {
        float mu = min(wo.z, 1.0f);
        vec2 m = sheenZeltnerTransform(mu, l.roughness);
        vec2 azimuth = sheenAzimuth(wo);
        float x = azimuth.x * wi.x + azimuth.y * wi.y;
        float y = azimuth.x * wi.y - azimuth.y * wi.x;
        vec3 w = vec3(m.x * x + m.y * wi.z, m.x * y, wi.z);
        float len2 = max(dot(w, w), TINY);
        e.pdf = wi.z * INV_PI * sqr(m.x / len2);
        e.value = l.color * (e.pdf * sheenZeltnerAlbedo(mu, l.roughness));
        return e;
    }
    vec2 v = sheenContyKulla(l.roughness, wo, wi);
    e.value = l.color * (v.x / max(sheenReflects(min(wo.z, 1.0f), l.roughness, l.albedo), 1.0f));
    e.pdf = v.y;
    return e;
}

PATINA_FN LobeSample sheenSample(SheenLobe l, vec3 wo, vec3 u) {
    if (wo.z < 0.0f) return lobeSampleNone();
    LobeSample s = lobeSampleNone();
    float phi = TWO_PI * u.y;
    if (l.mode == SHEEN_ZELTNER) {
        vec2 m = sheenZeltnerTransform(min(wo.z, 1.0f), l.roughness);
        vec2 azimuth = sheenAzimuth(wo);
        vec3 c = sampleCosineHemisphere(vec2(u.x, u.y));
        vec3 w = normalize(vec3(c.x - c.z * m.y, c.y, c.z * m.x));
        s.wi = vec3(azimuth.x * w.x - azimuth.y * w.y, azimuth.y * w.x + azimuth.x * w.y, w.z);
    } else if (u.z < sheenHalfShare(l.roughness)) {
        // Half vectors with density D h.z: sin^(2 + 1 / roughness) is uniform.
        float sine = powSchlick(u.x, 1.0f / (2.0f + 1.0f / l.roughness));
        vec3 h = vec3(sine * cos(phi), sine * sin(phi), safeSqrt(1.0f - sine * sine));
        float c = dot(wo, h);
        s.wi = h * (2.0f * c) - wo;
        if (c <= 0.0f) return lobeSampleNone();
    } else {
        float r = safeSqrt(1.0f - u.x * u.x);
        s.wi = vec3(r * cos(phi), r * sin(phi), u.x);
    }
    LobeEval e = sheenEval(l, wo, s.wi);
    bool found = e.pdf > 0.0f;
    s.weight = e.value / max(e.pdf, TINY);
    s.pdf = e.pdf;
    s.event = select(LOBE_REFLECT, 0, found);
    return s;
}

PATINA_FN vec3 sheenAlbedo(SheenLobe l, vec3 wo) {
    if (wo.z < 0.0f) return vec3(0.0f);
    return l.color * sheenWhiteAlbedo(l, wo.z);
}

PATINA_FN vec3 lobeFix(PATINA_INOUT(SheenLobe) l, vec3 wo, PATINA_OUT(vec3) albedo) {
    float coverage = 0.0f;
    if (wo.z >= 0.0f) coverage = sheenWhiteAlbedo(l, wo.z);
    albedo = l.color * coverage;
    return vec3(coverage);
}

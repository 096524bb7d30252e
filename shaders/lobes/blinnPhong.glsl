// SPDX-License-Identifier: Apache-2.0
// Blinn 1977 with a cosine power of the half vector, normalised exactly to the colour at normal
// incidence: factor (n + 2) (n + 4) / (8 PI (n + 2^(-n/2))), which gains nowhere (Giesen 2009,
// "Phong Normalization Factor derivation"). Reciprocal, one-sided.

struct BlinnPhongLobe {
    vec3 color;
    float exponent;
    float scale;
};

// color: albedo at normal incidence. exponent: in [0, EXPONENT_MAX].
PATINA_FN BlinnPhongLobe blinnPhongSetup(vec3 color, float exponent) {
    BlinnPhongLobe l;
    l.color = lobeColor(color);
    l.exponent = clamp(exponent, 0.0f, EXPONENT_MAX);
    float n = l.exponent;
    l.scale = (n + 2.0f) * (n + 4.0f) * 0.125f * INV_PI / (n + exp2(-0.5f * n));
    return l;
}

PATINA_FN LobeEval blinnPhongEval(BlinnPhongLobe l, vec3 wo, vec3 wi) {
    if (wo.z < 0.0f || wi.z <= 0.0f) return lobeEvalNone();
    vec3 h = wo + wi;
    float h2 = max(dot(h, h), TINY);
    float sine2 = clamp((h.x * h.x + h.y * h.y) / h2, 0.0f, 1.0f);
    // cos^n of the half vector as a power of 1 - sin^2.
    float power = powFromVersine(sine2, 0.5f * l.exponent);
    LobeEval e;
    e.value = l.color * (power * l.scale * wi.z);
    // The density of half vectors over 4 o.h = 2 |h|.
    e.pdf = power * (l.exponent + 1.0f) * 0.25f * INV_PI / sqrt(h2);
    return e;
}

PATINA_FN LobeSample blinnPhongSample(BlinnPhongLobe l, vec3 wo, vec3 u) {
    if (wo.z < 0.0f) return lobeSampleNone();
    vec3 h =
        aroundAxis(vec3(0.0f, 0.0f, 1.0f), sampleVersine(u.x, l.exponent + 1.0f), TWO_PI * u.y);
    float c = dot(wo, h);
    LobeSample s = lobeSampleNone();
    s.wi = h * (2.0f * c) - wo;
    if (c <= 0.0f) return lobeSampleNone();
    LobeEval e = blinnPhongEval(l, wo, s.wi);
    bool found = e.pdf > 0.0f;
    s.weight = e.value / max(e.pdf, TINY);
    s.pdf = e.pdf;
    s.event = select(LOBE_REFLECT, 0, found);
    return s;
}

PATINA_FN vec3 blinnPhongAlbedo(BlinnPhongLobe l, vec3 wo) {
    if (wo.z < 0.0f) return vec3(0.0f);
    return l.color * classicAlbedo(CLASSIC_BLINN_PHONG, wo.z, phongAlpha(l.exponent));
}

PATINA_FN float lobeRoughness(BlinnPhongLobe l) {
    return phongAlpha(l.exponent);
}

// SPDX-License-Identifier: Apache-2.0
// Diffuse reflection of Burley 2012 ("Physically Based Shading at Disney"): MaterialX
// burley_diffuse_bsdf. Reciprocal, one-sided. Not energy preserving: a white lobe of roughness 1
// gains 12 percent at 70 degrees and 56 at the horizon, and loses at roughness 0; that is the model.

struct BurleyLobe {
    vec3 color;
    float roughness;
};

// color: diffuse reflectivity. roughness: in [0, 1].
PATINA_FN BurleyLobe burleySetup(vec3 color, float roughness) {
    BurleyLobe l;
    l.color = lobeColor(color);
    l.roughness = clamp(roughness, 0.0f, 1.0f);
    return l;
}

// With cos^2 of the half angle = (1 + o.i) / 2 the grazing factor FD90 - 1 is r (1 + o.i) - 1/2: no
// half vector needed.
PATINA_FN LobeEval burleyEval(BurleyLobe l, vec3 wo, vec3 wi) {
    if (wo.z < 0.0f || wi.z <= 0.0f) return lobeEvalNone();
    float rise = l.roughness * (1.0f + dot(wo, wi)) - 0.5f;
    float fo = 1.0f + rise * powSchlick(max(1.0f - wo.z, 0.0f), 5.0f);
    float fi = 1.0f + rise * powSchlick(max(1.0f - wi.z, 0.0f), 5.0f);
    LobeEval e;
    e.pdf = wi.z * INV_PI;
    e.value = l.color * (max(fo * fi, 0.0f) * e.pdf);
    return e;
}

PATINA_FN LobeSample burleySample(BurleyLobe l, vec3 wo, vec3 u) {
    LobeSample s = lobeSampleNone();
    s.wi = sampleCosineHemisphere(vec2(u.x, u.y));
    LobeEval e = burleyEval(l, wo, s.wi);
    bool found = e.pdf > 0.0f;
    s.weight = e.value / max(e.pdf, TINY);
    s.pdf = e.pdf;
    s.event = select(LOBE_REFLECT, 0, found);
    return s;
}

// Exact: the lobe is a polynomial in cos i, sin o sin i cos(phi) and (1 - cos i)^5, so the integral
// is one in cos o. With k = r - 1/2 and a = (1 - cos o)^5; 1/21, 1/84, 1/252 are the integrals of 2
// x^(n+1) (1 - x)^5 for n = 0, 1, 2.
PATINA_FN vec3 burleyAlbedo(BurleyLobe l, vec3 wo) {
    if (wo.z < 0.0f) return vec3(0.0f);
    float c = min(wo.z, 1.0f);
    float r = l.roughness;
    float k = r - 0.5f;
    float a = powSchlick(1.0f - c, 5.0f);
    const float j0 = 1.0f / 21.0f;
    const float j1 = 1.0f / 84.0f;
    const float j2 = 1.0f / 252.0f;
    float linear = a * (k + r * c * (2.0f / 3.0f)) + k * j0 + r * c * j1;
    float square = a * (k * k * j0 + 2.0f * k * r * c * j1 +
                        r * r * (c * c * j2 + 0.5f * (1.0f - c * c) * (j0 - j2)));
    return l.color * (1.0f + linear + square);
}

PATINA_FN vec3 lobeFix(PATINA_INOUT(BurleyLobe) l, PATINA_UNUSED(vec3, wo), PATINA_OUT(vec3) albedo) {
    albedo = l.color;
    return vec3(1.0f);
}

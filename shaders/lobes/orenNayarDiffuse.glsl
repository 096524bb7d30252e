// SPDX-License-Identifier: Apache-2.0
// Rough diffuse reflection: MaterialX oren_nayar_diffuse_bsdf. Without energy compensation the
// qualitative model of Oren and Nayar 1994, with it the energy preserving model EON of Portsmouth,
// Kutz and Hill 2025 ("EON: a practical energy-preserving rough diffuse BRDF"), which is Fujii's
// improved model plus a multiple scattering term. Both are Lambert at roughness 0. Reciprocal,
// one-sided.

struct OrenNayarLobe {
    vec3 color;
    vec3 multi; // colour of EON's second term with its constant, 0 without compensation
    float a;    // value at zero s
    float b;    // factor on s / t
    float neg;  // 1 keeps negative s (Fujii), 0 clamps it (qualitative model)
};

// 1/2 - 2/(3 PI): the loss of Fujii's model at normal incidence per roughness. 2/3 - 28/(15 PI):
// the gain of its mean albedo over a.
const float FUJII_LOSS = 0.28779340921f;
const float FUJII_GAIN = 0.07248821230f;

// color: diffuse reflectivity. roughness: standard deviation of slopes (radians) of the qualitative
// model, or EON's roughness; clamped to [0, 1].
PATINA_FN OrenNayarLobe orenNayarSetup(vec3 color, float roughness, bool energyCompensation) {
    OrenNayarLobe l;
    l.color = lobeColor(color);
    float r = clamp(roughness, 0.0f, 1.0f);
    float s2 = r * r;
    float fa = 1.0f / (1.0f + FUJII_LOSS * r);
    float mean = fa * (1.0f + FUJII_GAIN * r);
    l.a = select(fa, 1.0f - 0.5f * s2 / (s2 + 0.33f), energyCompensation);
    l.b = select(fa * r, 0.45f * s2 / (s2 + 0.09f), energyCompensation);
    l.neg = select(1.0f, 0.0f, energyCompensation);
    // (1 - E(o)) (1 - E(i)) / (1 - mean E) is proportional to r: with loss(mu) = FUJII_LOSS - G(mu)
    // / PI it is fa r loss(o) loss(i) / (FUJII_LOSS - FUJII_GAIN), without a quotient of two
    // vanishing terms.
    vec3 c = min(l.color, vec3(1.0f));
    vec3 ms = c * c * mean / (vec3(1.0f) - c * (1.0f - mean));
    l.multi = ms * (l.neg * fa * r / (FUJII_LOSS - FUJII_GAIN));
    return l;
}

// The choice point diffuse. energyCompensation: what the node says.
const int DIFFUSE_AUTHORED = 0;
const int DIFFUSE_LAMBERT = 1;
const int DIFFUSE_QUALITATIVE = 2;
const int DIFFUSE_EON = 3;

PATINA_FN OrenNayarLobe orenNayarModel(vec3 color, float roughness, bool energyCompensation,
                                       int model) {
    bool eon = (model == DIFFUSE_AUTHORED && energyCompensation) || model == DIFFUSE_EON;
    return orenNayarSetup(color, select(0.0f, roughness, model == DIFFUSE_LAMBERT), eon);
}

// Integral of s / t over the cosine hemisphere, divided by what remains in PI: G(mu) of Fujii's
// model, exact (neg = 1), or that of the qualitative model (neg = 0).
PATINA_FN float orenNayarG(float mu, float neg) {
    float s = safeSqrt(1.0f - mu * mu);
    // (1 - s^3) / mu with the zero at mu = 0 divided out.
    float tail = mu * (1.0f + s + s * s) / (1.0f + s);
    return s * (acosUnit(mu) - s * mu + (2.0f / 3.0f) * (tail - neg));
}

PATINA_FN float orenNayarLoss(float mu, float neg) {
    return max(FUJII_LOSS - INV_PI * orenNayarG(mu, neg), 0.0f);
}

PATINA_FN LobeEval orenNayarEval(OrenNayarLobe l, vec3 wo, vec3 wi) {
    if (wo.z < 0.0f || wi.z <= 0.0f) return lobeEvalNone();
    float s = dot(wo, wi) - wo.z * wi.z;
    float positive = s / max(max(wo.z, wi.z), TINY);
    float st = select(positive, s * l.neg, s > 0.0f);
    vec3 f = l.color * max(l.a + l.b * st, 0.0f);
    if (l.multi.x + l.multi.y + l.multi.z > 0.0f)
        f += l.multi * (orenNayarLoss(wo.z, 1.0f) * orenNayarLoss(wi.z, 1.0f));
    LobeEval e;
    e.pdf = wi.z * INV_PI;
    e.value = f * e.pdf;
    return e;
}

PATINA_FN LobeSample orenNayarSample(OrenNayarLobe l, vec3 wo, vec3 u) {
    LobeSample s = lobeSampleNone();
    s.wi = sampleCosineHemisphere(vec2(u.x, u.y));
    LobeEval e = orenNayarEval(l, wo, s.wi);
    bool found = e.pdf > 0.0f;
    s.weight = e.value / max(e.pdf, TINY);
    s.pdf = e.pdf;
    s.event = select(LOBE_REFLECT, 0, found);
    return s;
}

// Exact for both models.
PATINA_FN vec3 orenNayarAlbedo(OrenNayarLobe l, vec3 wo) {
    if (wo.z < 0.0f) return vec3(0.0f);
    float mu = min(wo.z, 1.0f);
    float single = l.a + l.b * INV_PI * orenNayarG(mu, l.neg);
    // loss(i) averages to FUJII_LOSS - FUJII_GAIN.
    return l.color * single + l.multi * (orenNayarLoss(mu, 1.0f) * (FUJII_LOSS - FUJII_GAIN));
}

PATINA_FN vec3 lobeFix(PATINA_INOUT(OrenNayarLobe) l, PATINA_UNUSED(vec3, wo), PATINA_OUT(vec3) albedo) {
    albedo = l.color;
    return vec3(1.0f);
}

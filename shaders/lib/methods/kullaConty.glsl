// SPDX-License-Identifier: Apache-2.0
// The choice point energyCompensation, method kullaConty (Kulla and Conty 2017, "Revisiting
// Physically Based Shading at Imageworks"): a second lobe holds what single scattering loses,
//   (1 - E(o)) (1 - E(i)) / (PI (1 - mean E)) times a colour,
// with E the albedo of a white lobe. Reciprocal and shaped like diffuse. For lobes that reflect
// only, from the thinner side; others are scaled (energy.glsl).

// 1 - mean E of isotropic facets: polynomials fitted to quadrature, within 1e-3.
PATINA_FN float multiLoss(float alpha, int ndf) {
    float g =
        alpha * (0.0899281f +
                 alpha * (2.25982f + alpha * (-3.55654f + alpha * (2.51304f - alpha * 0.715887f))));
    float b =
        alpha *
        (0.0021705f +
         alpha * (0.463756f + alpha * (-0.021915f + alpha * (-0.155818f + alpha * 0.0480315f))));
    return select(b, g, ndf == NDF_BECKMANN);
}

struct MultiLobe {
    vec3 color;   // albedo of the second lobe at the wo at hand
    float rate;   // color times this times 1 - E(i) is the value, without the cosine
    float chance; // of drawing it
};

// favg: mean reflectance. ess: E(wo). Below MULTI_LOSS_MIN the loss is noise of the tables.
PATINA_FN MultiLobe multiLobe(vec3 favg, float ess, vec2 alpha, int ndf) {
    MultiLobe l;
    float loss = max(multiLoss(sqrt(0.5f * dot(alpha, alpha)), ndf), MULTI_LOSS_MIN);
    float meanAlbedo = max(1.0f - loss, ALBEDO_MIN);
    vec3 white = favg * favg * meanAlbedo / max(vec3(1.0f) - favg * loss, vec3(ALBEDO_MIN));
    l.color = white * (1.0f - ess);
    l.rate = INV_PI / loss;
    float second = lobeMean(l.color);
    l.chance = second / max(second + lobeMean(favg) * ess, TINY);
    return l;
}

// Value and density that the second lobe adds to a lobe. essIn: E(wi).
PATINA_FN LobeEval multiAdd(MultiLobe l, LobeEval e, float iz, float essIn) {
    e.value += l.color * (l.rate * (1.0f - essIn) * iz);
    e.pdf = mix(e.pdf, INV_PI * iz, l.chance);
    return e;
}

// A direction of one of both lobes: the choice is u.z's.
PATINA_FN vec3 multiSample(MultiLobe l, vec3 wo, vec2 alpha, vec3 u, int ndf, int sampling) {
    vec3 m = microfacetSample(wo, alpha, vec2(u.x, u.y), ndf, sampling);
    vec3 wi = m * (2.0f * max(dot(wo, m), 0.0f)) - wo;
    return select(sampleCosineHemisphere(vec2(u.x, u.y)), wi, u.z < l.chance);
}

// e: value and density of both lobes at wi.
PATINA_FN LobeSample multiSampled(vec3 wi, LobeEval e) {
    if (e.pdf <= 0.0f) return lobeSampleNone();
    LobeSample s;
    s.wi = wi;
    s.weight = e.value / e.pdf;
    s.pdf = e.pdf;
    s.event = LOBE_REFLECT;
    s.eta = 1.0f;
    return s;
}

// SPDX-License-Identifier: Apache-2.0
// Phong 1975 about the mirror direction, normalised so that it is reciprocal and never gains
// energy (Lafortune and Willems 1994, "Using the Modified Phong Reflectance Model for Physically
// Based Rendering"). A sharp lobe reflects cos(theta) only: that is the model. One-sided.

struct PhongLobe {
    vec3 color;
    float exponent;
};

// color: albedo at normal incidence. exponent: in [0, EXPONENT_MAX].
PATINA_FN PhongLobe phongSetup(vec3 color, float exponent) {
    PhongLobe l;
    l.color = lobeColor(color);
    l.exponent = clamp(exponent, 0.0f, EXPONENT_MAX);
    return l;
}

PATINA_FN LobeEval phongEval(PhongLobe l, vec3 wo, vec3 wi) {
    if (wo.z < 0.0f || wi.z <= 0.0f) return lobeEvalNone();
    // 1 - cos of the angle to the mirror direction.
    vec3 d = wi - vec3(-wo.x, -wo.y, wo.z);
    float power = powFromVersine(0.5f * dot(d, d), l.exponent);
    LobeEval e;
    e.pdf = power * (l.exponent + 1.0f) * 0.5f * INV_PI;
    e.value = l.color * (power * wi.z * (l.exponent + 2.0f) * 0.5f * INV_PI);
    return e;
}

PATINA_FN LobeSample phongSample(PhongLobe l, vec3 wo, vec3 u) {
    if (wo.z < 0.0f) return lobeSampleNone();
    float v = sampleVersine(u.x, l.exponent + 1.0f);
    LobeSample s = lobeSampleNone();
    s.wi = aroundAxis(vec3(-wo.x, -wo.y, wo.z), v, TWO_PI * u.y);
    LobeEval e = phongEval(l, wo, s.wi);
    bool found = e.pdf > 0.0f;
    s.weight = e.value / max(e.pdf, TINY);
    s.pdf = e.pdf;
    s.event = select(LOBE_REFLECT, 0, found);
    return s;
}

PATINA_FN vec3 phongAlbedo(PhongLobe l, vec3 wo) {
    if (wo.z < 0.0f) return vec3(0.0f);
    return l.color * classicAlbedo(CLASSIC_PHONG, wo.z, phongAlpha(l.exponent));
}

PATINA_FN float lobeRoughness(PhongLobe l) {
    return phongAlpha(l.exponent);
}

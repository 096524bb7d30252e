// SPDX-License-Identifier: Apache-2.0
// Phase function of a medium (Henyey and Greenstein 1941). Unlike a lobe it has no shading frame:
// wo and wi are unit vectors in any common frame, and both point away from the scattering point.
// Its value is its density, so it integrates to 1. Reciprocal.

struct PhaseHenyeyGreensteinLobe {
    float g;
};

// anisotropy: mean cosine of the deflection, from -1 (back) to 1 (straight on).
PATINA_FN PhaseHenyeyGreensteinLobe phaseHenyeyGreensteinSetup(float anisotropy) {
    PhaseHenyeyGreensteinLobe l;
    l.g = clamp(anisotropy, -PHASE_ANISOTROPY_MAX, PHASE_ANISOTROPY_MAX);
    l.g = select(l.g, 0.0f, anisotropy == anisotropy);
    return l;
}

PATINA_FN LobeEval phaseHenyeyGreensteinEval(PhaseHenyeyGreensteinLobe l, vec3 wo, vec3 wi) {
    // 1 + g^2 - 2 g cos as a sum of squares: it keeps its precision at the peak.
    vec3 off = select(wi + wo, wi - wo, l.g >= 0.0f);
    float g = abs(l.g);
    float d = sqr(1.0f - g) + g * dot(off, off);
    LobeEval e;
    e.pdf = 0.25f * INV_PI * (1.0f - g * g) / (d * sqrt(d));
    e.value = vec3(e.pdf);
    return e;
}

PATINA_FN LobeSample phaseHenyeyGreensteinSample(PhaseHenyeyGreensteinLobe l, vec3 wo, vec3 u) {
    // 1 - cos and 1 + cos of the deflection, inverted analytically and written so that g may be 0.
    float g = l.g;
    float t = 2.0f * u.x - 1.0f;
    float scale = 0.5f / sqr(1.0f + g * t);
    float less = sqr(1.0f - g) * (1.0f - t) * (2.0f + g + g * t) * scale;
    float more = sqr(1.0f + g) * (1.0f + t) * (2.0f - g + g * t) * scale;
    float c = select(1.0f - less, more - 1.0f, less < more);
    float r = safeSqrt(less * more);
    float phi = TWO_PI * u.y;

    // Basis about the direction that light goes on in (Duff et al. 2017).
    vec3 n = -wo;
    float side = select(1.0f, -1.0f, n.z >= 0.0f);
    float a = -1.0f / (side + n.z);
    float b = n.x * n.y * a;
    vec3 x = vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x);
    vec3 y = vec3(b, side + n.y * n.y * a, -n.y);

    LobeSample s = lobeSampleNone();
    s.wi = x * (r * cos(phi)) + y * (r * sin(phi)) + n * c;
    s.pdf = phaseHenyeyGreensteinEval(l, wo, s.wi).pdf;
    s.weight = vec3(1.0f);
    s.event = LOBE_TRANSMIT;
    return s;
}

PATINA_FN vec3 phaseHenyeyGreensteinAlbedo(PATINA_UNUSED(PhaseHenyeyGreensteinLobe, l),
                                         PATINA_UNUSED(vec3, wo)) {
    return vec3(1.0f);
}

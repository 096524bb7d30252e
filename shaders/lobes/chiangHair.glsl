// SPDX-License-Identifier: Apache-2.0
// Light scattered by a hair fibre: MaterialX chiang_hair_bsdf. Chiang, Bitterli, Tappan and Burley
// 2016 ("A Practical and Controllable Hair and Fur Model for Production Path Tracing") on the
// longitudinal lobe of d'Eon et al. 2011 ("An Energy-Conserving Hair Reflectance Model"): lobes R,
// TT, TRT and all further ones, each a product of a longitudinal part M, an azimuthal part N and
// the attenuation A. Both hemispheres; x is along the fibre towards its tip, z the shading normal.
//
// Where on the fibre's width a ray arrives, h, follows from wo: the shading normal of a curve faces
// about as the fibre does there, so sin gamma is the y of wo across the fibre. Not reciprocal: h
// belongs to wo.

struct ChiangHairLobe {
    vec3 tintR;
    vec3 tintTT;
    vec3 tintTRT;
    vec3 absorption; // per fibre radius
    vec3 v;          // longitudinal variance of R, TT, TRT
    vec3 s;          // azimuthal logistic scale of R, TT, TRT
    float ior;
    float cuticle; // tilt of the scales, radians
};

// roughnessR, TT, TRT: longitudinal variance and azimuthal logistic scale. cuticleAngle: 0..1 for
// -90..90 degrees, 0.5 is none. absorption: per radius of the fibre.
PATINA_FN ChiangHairLobe chiangHairSetup(vec3 tintR, vec3 tintTT, vec3 tintTRT, float ior,
                                         vec2 roughnessR, vec2 roughnessTT, vec2 roughnessTRT,
                                         float cuticleAngle, vec3 absorption) {
    ChiangHairLobe l;
    l.tintR = min(lobeColor(tintR), vec3(1.0f));
    l.tintTT = min(lobeColor(tintTT), vec3(1.0f));
    l.tintTRT = min(lobeColor(tintTRT), vec3(1.0f));
    l.absorption = lobeColor(absorption);
    l.v = min(max(vec3(roughnessR.x, roughnessTT.x, roughnessTRT.x), vec3(HAIR_VARIANCE_MIN)),
              vec3(HAIR_VARIANCE_MAX));
    l.s = min(max(vec3(roughnessR.y, roughnessTT.y, roughnessTRT.y), vec3(HAIR_SCALE_MIN)),
              vec3(HAIR_SCALE_MAX));
    l.ior = clamp(ior, 1.0f + IOR_MATCHED, IOR_MAX);
    l.cuticle = PI * (clamp(cuticleAngle, 0.0f, 1.0f) - 0.5f);
    return l;
}

PATINA_FN float hairExp(float x) {
    return exp2(1.44269504f * x);
}

// I0 of the longitudinal lobe times exp(-|x|), after Abramowitz and Stegun 1964, 9.8.1 and 9.8.2:
// within 2e-7.
PATINA_FN float hairBesselScaled(float x) {
    float t = x / 3.75f;
    float t2 = t * t;
    float low =
        1.0f +
        t2 * (3.5156229f +
              t2 * (3.0899424f +
                    t2 * (1.2067492f + t2 * (0.2659732f + t2 * (0.0360768f + t2 * 0.0045813f)))));
    float i = 1.0f / max(t, 1.0f);
    float high =
        0.39894228f +
        i * (0.01328592f +
             i * (0.00225319f +
                  i * (-0.00157565f +
                       i * (0.00916281f +
                            i * (-0.02057706f +
                                 i * (0.02635537f + i * (-0.01647633f + i * 0.00392377f)))))));
    return select(low * hairExp(-x), high / sqrt(max(x, 1.0f)), t <= 1.0f);
}

// d'Eon's longitudinal lobe, normalised over sin theta i dphi: integral of M cos theta i d theta i
// is 1. Its normalisation 1 / (2 v sinh(1 / v)) is written with exponentials that cannot overflow.
PATINA_FN float hairM(float sinI, float cosI, float sinO, float cosO, float v) {
    float a = cosI * cosO / v;
    float b = sinI * sinO / v;
    // exp(-b) I0(a) / (2 v sinh(1/v)).
    return hairExp(a - b - 1.0f / v) * hairBesselScaled(a) / (v * (1.0f - hairExp(-2.0f / v)));
}

PATINA_FN float hairLogisticCdf(float x, float s) {
    return 1.0f / (1.0f + hairExp(clamp(-x / s, -80.0f, 80.0f)));
}

// Logistic distribution cut to [-PI, PI] and normalised there.
PATINA_FN float hairLogistic(float x, float s) {
    float e = hairExp(-abs(x) / s);
    float d = e / (s * sqr(1.0f + e));
    return d / (hairLogisticCdf(PI, s) - hairLogisticCdf(-PI, s));
}

PATINA_FN float hairLogisticSample(float u, float s) {
    float lo = hairLogisticCdf(-PI, s);
    float hi = hairLogisticCdf(PI, s);
    float c = clamp(mix(lo, hi, u), 1e-7f, 1.0f - 1e-7f);
    return clamp(-s * 0.693147181f * log2((1.0f - c) / c), -PI, PI); // 1 - c is exact, 1 / c is not
}

// Arc sine on [-1, 1].
PATINA_FN float hairAsin(float x) {
    float a = 0.5f * PI - acosUnit(min(abs(x), 1.0f));
    return select(a, -a, x >= 0.0f);
}

// Angle of (x, y), in [-PI, PI].
PATINA_FN float hairAngle(float x, float y) {
    float r = 1.0f / sqrt(max(x * x + y * y, TINY));
    float ax = abs(x);
    float ay = abs(y);
    float a = hairAsin(min(ax, ay) * r);
    a = select(a, 0.5f * PI - a, ay <= ax);
    a = select(a, PI - a, x >= 0.0f);
    return select(a, -a, y >= 0.0f);
}

PATINA_FN float hairWrap(float phi) {
    return phi - TWO_PI * floor((phi + PI) / TWO_PI);
}

// All that hangs on wo alone.
struct HairOut {
    float sinO;
    float cosO;
    float phiO;
    float gammaO;
    float gammaT;
    vec3 a0; // attenuation of R, TT, TRT and the rest
    vec3 a1;
    vec3 a2;
    vec3 a3;
};

PATINA_FN HairOut hairOut(ChiangHairLobe l, vec3 wo) {
    HairOut o;
    o.sinO = clamp(wo.x, -1.0f, 1.0f);
    // Not 1 - sin^2, of which nothing is left near the axis but how wo was rounded.
    o.cosO = sqrt(wo.y * wo.y + wo.z * wo.z);
    o.phiO = hairAngle(wo.z, wo.y);
    // The normal is across the fibre from where wo would meet its axis: h = sin(phi of wo).
    float h = clamp(wo.y / max(o.cosO, 1e-4f), -HAIR_H_MAX, HAIR_H_MAX);
    o.gammaO = hairAsin(h);
    float sinT = o.sinO / l.ior;
    float cosT = safeSqrt(1.0f - sinT * sinT);
    // Bravais index for the projection across the fibre.
    float etaP = sqrt(max(l.ior * l.ior - o.sinO * o.sinO, TINY)) / max(o.cosO, 1e-4f);
    float sinGammaT = clamp(h / etaP, -1.0f, 1.0f);
    float cosGammaT = safeSqrt(1.0f - sinGammaT * sinGammaT);
    o.gammaT = hairAsin(sinGammaT);
    vec3 sigma = l.absorption * (-2.0f * cosGammaT / max(cosT, 1e-4f));
    vec3 t = vec3(hairExp(sigma.x), hairExp(sigma.y), hairExp(sigma.z));
    float f = fresnelDielectric(o.cosO * safeSqrt(1.0f - h * h), l.ior);
    o.a0 = vec3(f);
    o.a1 = t * sqr(1.0f - f);
    o.a2 = o.a1 * t * f;
    o.a3 = o.a2 * t * f / max(vec3(1.0f) - t * f, vec3(ALBEDO_MIN));
    o.a0 *= l.tintR;
    o.a1 *= l.tintTT;
    o.a2 *= l.tintTRT;
    o.a3 *= l.tintTRT;
    return o;
}

// Chance of lobe p: its share of the attenuation; none where the fibre absorbs all.
PATINA_FN vec4 hairChances(HairOut o) {
    vec4 a = vec4(lobeMean(o.a0), lobeMean(o.a1), lobeMean(o.a2), lobeMean(o.a3));
    float sum = a.x + a.y + a.z + a.w;
    float scale = select(1.0f / max(sum, TINY), 0.0f, sum > TINY);
    return vec4(a.x * scale, a.y * scale, a.z * scale, a.w * scale);
}

// sin and cos of theta o less `angle`: the scales tilt R, TT, TRT by -2, 1, 4 times their own.
PATINA_FN vec2 hairTilted(HairOut o, float angle) {
    float c = cos(angle);
    float s = sin(angle);
    return vec2(o.sinO * c - o.cosO * s, abs(o.cosO * c + o.sinO * s));
}

PATINA_FN float hairPhi(float p, HairOut o) {
    return 2.0f * p * o.gammaT - 2.0f * o.gammaO + p * PI;
}

PATINA_FN float hairLobeDensity(vec2 tilted, float sinI, float cosI, float v, float phi, float at,
                                float s) {
    return hairM(sinI, cosI, tilted.x, tilted.y, v) * hairLogistic(hairWrap(phi - at), s);
}

PATINA_FN LobeEval chiangHairEval(ChiangHairLobe l, vec3 wo, vec3 wi) {
    HairOut o = hairOut(l, wo);
    float sinI = clamp(wi.x, -1.0f, 1.0f);
    float cosI = sqrt(wi.y * wi.y + wi.z * wi.z);
    float phi = hairAngle(wi.z, wi.y) - o.phiO;
    vec2 tilt0 = hairTilted(o, -2.0f * l.cuticle);
    vec2 tilt1 = hairTilted(o, l.cuticle);
    vec2 tilt2 = hairTilted(o, 4.0f * l.cuticle);
    float d0 = hairLobeDensity(tilt0, sinI, cosI, l.v.x, phi, hairPhi(0.0f, o), l.s.x);
    float d1 = hairLobeDensity(tilt1, sinI, cosI, l.v.y, phi, hairPhi(1.0f, o), l.s.y);
    float d2 = hairLobeDensity(tilt2, sinI, cosI, l.v.z, phi, hairPhi(2.0f, o), l.s.z);
    float d3 = hairM(sinI, cosI, o.sinO, o.cosO, l.v.z) / TWO_PI;
    vec4 chance = hairChances(o);
    LobeEval e;
    e.value = o.a0 * d0 + o.a1 * d1 + o.a2 * d2 + o.a3 * d3;
    e.pdf = chance.x * d0 + chance.y * d1 + chance.z * d2 + chance.w * d3;
    return e;
}

// Chances that the rounding of the others' sum decides: what is drawn by them alone may have no density.
const float HAIR_SELDOM = 1e-7f;

PATINA_FN LobeSample chiangHairSample(ChiangHairLobe l, vec3 wo, vec3 u) {
    HairOut o = hairOut(l, wo);
    vec4 chance = hairChances(o);
    // u.z chooses the lobe, and what is left of it turns the direction about the cone.
    float left = u.z;
    float p = 0.0f;
    float part = chance.x;
    if (left >= part && chance.y + chance.z + chance.w > HAIR_SELDOM) {
        left -= part;
        p = 1.0f;
        part = chance.y;
        if (left >= part && chance.z + chance.w > HAIR_SELDOM) {
            left -= part;
            p = 2.0f;
            part = chance.z;
            if (left >= part && chance.w > HAIR_SELDOM) {
                left -= part;
                p = 3.0f;
                part = chance.w;
            }
        }
    }
    float w = clamp(left / max(part, TINY), 0.0f, 0.9999999f);
    float tilt = select(-2.0f, select(1.0f, select(4.0f, 0.0f, p == 2.0f), p == 1.0f), p == 0.0f);
    float v = select(l.v.x, select(l.v.y, l.v.z, p == 1.0f), p == 0.0f);
    float s = select(l.s.x, select(l.s.y, l.s.z, p == 1.0f), p == 0.0f);
    vec2 to = hairTilted(o, tilt * l.cuticle);
    // d'Eon's sampling of M, in the form of Jakob 2012 that does not overflow.
    float x = max(u.x, 1e-6f);
    float c = 1.0f + v * 0.693147181f * log2(x + (1.0f - x) * hairExp(-2.0f / v));
    c = clamp(c, -1.0f, 1.0f);
    float r = safeSqrt(1.0f - c * c);
    float rx = r * cos(TWO_PI * u.y);
    float ry = r * sin(TWO_PI * u.y);
    float sinI = clamp(rx * to.y - c * to.x, -1.0f, 1.0f);
    // Not 1 - sin^2: all directions within 2e-4 of the axis would round to it.
    float across = rx * to.x + c * to.y;
    float cosI = sqrt(across * across + ry * ry);
    float phi = select(hairPhi(p, o) + hairLogisticSample(w, s), TWO_PI * w, p < 3.0f) + o.phiO;
    LobeSample d = lobeSampleNone();
    d.wi = vec3(sinI, cosI * sin(phi), cosI * cos(phi));
    LobeEval e = chiangHairEval(l, wo, d.wi);
    bool found = e.pdf > 0.0f;
    d.weight = e.value / max(e.pdf, TINY);
    d.pdf = e.pdf;
    bool same = d.wi.z * select(1.0f, -1.0f, wo.z >= 0.0f) > 0.0f;
    d.event = select(select(LOBE_REFLECT, LOBE_TRANSMIT, same), 0, found);
    return d;
}

// Exact: every lobe integrates to its attenuation.
PATINA_FN vec3 chiangHairAlbedo(ChiangHairLobe l, vec3 wo) {
    HairOut o = hairOut(l, wo);
    return o.a0 + o.a1 + o.a2 + o.a3;
}

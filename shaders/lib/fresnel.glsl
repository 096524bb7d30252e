// SPDX-License-Identifier: Apache-2.0
// Fresnel reflectance: exact for dielectrics and conductors, and the generalized Schlick curve. No
// approximation hides here.

// Unpolarised dielectric reflectance from both cosines: c on the side that light comes from, g =
// eta times that on the far side, so that g^2 = c^2 + eta^2 - 1. Written with eta^2 - 1 factored
// out of both amplitudes, which keeps its relative precision for eta near 1. The remainder of the
// second vanishes at Brewster's angle only; of its two forms the one for eta below 1 does not
// subtract from 1 what is nearly 1 around the critical angle.
PATINA_FN float fresnelFromCosines(float c, float g, float eta) {
    float e2 = eta * eta;
    float e = (eta - 1.0f) * (eta + 1.0f);
    float ds = c + g;
    float dp = e2 * c + g;
    float rs = e / max(ds * ds, TINY);
    float brewster = select((e2 + 1.0f) * c * c - 1.0f, (e2 + 1.0f) * g * g - e2 * e2, e >= 0.0f);
    float rp = e * brewster / max(dp * dp, TINY);
    return min(0.5f * (rs * rs + rp * rp), 1.0f);
}

// The same from c in [0, 1] alone. eta: ior of the far side over that of the near side. Total
// internal reflection gives 1, eta 1 gives exactly 0.
PATINA_FN float fresnelDielectric(float c, float eta) {
    float e = (eta - 1.0f) * (eta + 1.0f);
    float g2 = e + c * c;
    float f = fresnelFromCosines(c, safeSqrt(g2), eta);
    return select(1.0f, f, g2 <= 0.0f && e < 0.0f);
}

// Cosine on the far side of the interface; 0 at and beyond the critical angle.
PATINA_FN float cosRefracted(float c, float eta) {
    return safeSqrt((eta - 1.0f) * (eta + 1.0f) + c * c) / eta;
}

// Hemispherical (cosine weighted) average of fresnelDielectric: fits of Kulla and Conty 2017,
// "Revisiting Physically Based Shading at Imageworks", within 1e-3 up to eta 3; clamped beyond.
// Only the strength of the energy compensation hangs on it.
PATINA_FN float fresnelDielectricAverage(float eta) {
    float above = (eta - 1.0f) / (4.08567f + 1.00071f * eta);
    float below = 0.997118f + eta * (0.1014f - eta * (0.965241f + eta * 0.130607f));
    return clamp(select(above, below, eta >= 1.0f), 0.0f, 1.0f);
}

// One channel of a conductor with complex ior n + i k, light arriving through a medium of ior 1.
// Born and Wolf 1999, section 14.2, in the form without complex numbers. k = 0 equals
// fresnelDielectric(c, n), total reflection included.
PATINA_FN float fresnelConductorChannel(float c, float n, float k) {
    float c2 = c * c;
    float s2 = 1.0f - c2;
    float t0 = (n - k) * (n + k) - s2;
    float nk = 2.0f * n * k;
    float ab = sqrt(t0 * t0 + nk * nk);
    float a = safeSqrt(0.5f * (ab + t0));
    float ac = 2.0f * a * c;
    float rs = (ab + c2 - ac) / max(ab + c2 + ac, TINY);
    // n = k = 0 reflects all, at normal incidence too, where both parts vanish.
    float rp = (c2 * ab + s2 * s2 - ac * s2 + TINY) / (c2 * ab + s2 * s2 + ac * s2 + TINY);
    return clamp(0.5f * rs * (1.0f + rp), 0.0f, 1.0f);
}

PATINA_FN vec3 fresnelConductor(float c, vec3 n, vec3 k) {
    return vec3(fresnelConductorChannel(c, n.x, k.x), fresnelConductorChannel(c, n.y, k.y),
                fresnelConductorChannel(c, n.z, k.z));
}

// Generalized Schlick curve (Hoffman 2023, "Generalization of Adobe's Fresnel Model"):
//   F(c) = f0 + (f90 - f0) (1 - c)^exponent - dip c (1 - c)^6
// where dip makes F(1/7) equal color82 times its value without the dip.
struct SchlickFresnel {
    vec3 f0;
    vec3 f90;
    vec3 dip;
    float exponent;
};

PATINA_FN SchlickFresnel schlickFresnel(vec3 color0, vec3 color82, vec3 color90, float exponent) {
    SchlickFresnel s;
    s.f0 = min(lobeColor(color0), vec3(1.0f));
    s.f90 = min(lobeColor(color90), vec3(1.0f));
    s.exponent = clamp(exponent, 0.0f, 100.0f);
    float x = 6.0f / 7.0f;
    float x6 = (x * x) * (x * x) * (x * x);
    vec3 undipped = mix(s.f0, s.f90, powSchlick(x, s.exponent));
    s.dip = undipped * (vec3(1.0f) - min(lobeColor(color82), vec3(1.0f))) * (7.0f / x6);
    return s;
}

PATINA_FN vec3 fresnelSchlick(float c, SchlickFresnel s) {
    float x = clamp(1.0f - c, 0.0f, 1.0f);
    float x2 = x * x;
    vec3 f = mix(s.f0, s.f90, powSchlick(x, s.exponent)) - s.dip * (c * x2 * x2 * x2);
    return max(f, vec3(0.0f));
}

// Hemispherical average of the curve (before its clamp at 0): exact integrals of 2 c (1 - c)^p and
// 2 c^2 (1 - c)^6.
PATINA_FN vec3 fresnelSchlickAverage(SchlickFresnel s) {
    float b = 2.0f / ((s.exponent + 1.0f) * (s.exponent + 2.0f));
    return min(max(mix(s.f0, s.f90, b) - s.dip * (1.0f / 126.0f), vec3(0.0f)), vec3(1.0f));
}

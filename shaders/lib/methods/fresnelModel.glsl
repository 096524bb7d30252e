// SPDX-License-Identifier: Apache-2.0
// The choice point fresnel: the exact equations, or a curve through few of their values. Curves are
// for the thinner side and for lobes without film; from the denser side they are read at the cosine
// outside, and total reflection stays.

const int FRESNEL_EXACT = 0;
const int FRESNEL_SCHLICK = 1; // F0 + (1 - F0) (1 - c)^5
const int FRESNEL_F82 = 2; // with a dip that meets the exact value at c = 1/7 (Kutz et al. 2021)

// The curve of a model through the reflectances at cosine 1 and 1/7.
PATINA_FN SchlickFresnel fresnelCurve(int model, vec3 f0, vec3 f82) {
    float x = 6.0f / 7.0f;
    vec3 bare = mix(f0, vec3(1.0f), powSchlick(x, 5.0f));
    vec3 tint = select(f82 / max(bare, vec3(TINY)), vec3(1.0f), model == FRESNEL_F82);
    return schlickFresnel(f0, tint, vec3(1.0f), 5.0f);
}

PATINA_FN SchlickFresnel fresnelDielectricCurve(int model, float ior) {
    return fresnelCurve(model, vec3(sqr((ior - 1.0f) / (ior + 1.0f))),
                        vec3(fresnelDielectric(1.0f / 7.0f, ior)));
}

// Dielectric from either side; eta as in fresnelDielectric.
PATINA_FN float fresnelModelled(int model, float c, float eta) {
    if (model == FRESNEL_EXACT) return fresnelDielectric(c, eta);
    float ct = cosRefracted(c, eta);
    if (eta < 1.0f && ct <= 0.0f) return 1.0f;
    SchlickFresnel s = fresnelDielectricCurve(model, max(eta, 1.0f / eta));
    return min(fresnelSchlick(select(c, ct, eta >= 1.0f), s).x, 1.0f);
}

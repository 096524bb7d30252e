// SPDX-License-Identifier: Apache-2.0
// Multiple scattering between microfacets, as a factor on the single scattering lobe. A method
// choice: `compensate` is one of COMPENSATE_*. Scaling is not reciprocal (the factor hangs on wo
// only) and keeps the lobe's shape; methods/kullaConty.glsl adds a lobe instead.

const int COMPENSATE_NONE = 0;
const int COMPENSATE_SCALE = 1;
const int COMPENSATE_ADD = 2;

// Whether a lobe takes the second lobe; where it would not do, COMPENSATE_ADD scales too. thinner:
// wo is on the thinner side.
PATINA_FN bool energyAdds(int compensate, bool rough, bool thinner, int mode) {
    return PATINA_COMPENSATE(compensate) == COMPENSATE_ADD && rough && thinner && mode == SCATTER_R;
}

// Turquin 2019, "Practical multiple scattering compensation for microfacet models": 1 + favg (1 -
// ess) / ess, with the average Fresnel of the interface in place of F0. Never lifts an albedo above
// 1 as long as the lobe's own albedo is at most ess.
PATINA_FN float energyReflect(float ess, float favg, int compensate) {
    float k = 1.0f + favg * (1.0f - ess) / max(ess, ALBEDO_MIN);
    return select(k, 1.0f, PATINA_COMPENSATE(compensate) != COMPENSATE_NONE);
}

// The transmitted lobe takes the rest, so that a lossless interface loses nothing. er and et:
// single scattering albedos; kr: energyReflect. For light from the thinner side, where et never
// vanishes.
PATINA_FN float energyTransmit(float er, float et, float kr) {
    return max(1.0f - er * kr, 0.0f) / max(et, ALBEDO_MIN);
}

// From the denser side, close to total reflection, et does vanish: one factor for both lobes.
PATINA_FN float energyBoth(float er, float et) {
    return 1.0f / max(er + et, ALBEDO_MIN);
}

// Factor on a transmission lobe that lies under a reflection lobe: the layer above already scaled
// it by 1 - (albedo of reflection), so what the lobe's own Fresnel removed is given back. With the
// same ior and alpha on both, layer and transmission are exactly the RT lobe.
PATINA_FN float sharedInterfaceScale(float reflected, bool sharedInterface) {
    return select(1.0f / max(1.0f - reflected, ALBEDO_MIN), 1.0f, sharedInterface);
}

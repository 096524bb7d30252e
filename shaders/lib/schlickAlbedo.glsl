// SPDX-License-Identifier: Apache-2.0
// Mean reflectance of a generalized Schlick curve over the facets that wo sees: exact but for the
// tables (and the curve's clamp at 0). Times E[0] it is the single scattering albedo.
PATINA_FN vec3 schlickMean(MicrofacetPlace p, SchlickFresnel s) {
    float rise = microfacetMean(p, s.exponent);
    float dip = microfacetMean(p, 6.0f) - microfacetMean(p, 7.0f);
    return min(max(mix(s.f0, s.f90, rise) - s.dip * dip, vec3(0.0f)), vec3(1.0f));
}

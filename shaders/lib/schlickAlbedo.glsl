// Mean reflectance of a generalized Schlick curve over the facets that wo sees: exact but for the
// tables (and the curve's clamp at 0). Times E[0] it is the single scattering albedo.
PATINA_FN vec3 schlickMean(float mu, float alpha, SchlickFresnel s) {
    MomentPlace p = momentPlace(mu, alpha);
    float rise = momentMean(p, s.exponent);
    float dip = momentMean(p, 6.0f) - momentMean(p, 7.0f);
    return min(max(mix(s.f0, s.f90, rise) - s.dip * dip, vec3(0.0f)), vec3(1.0f));
}

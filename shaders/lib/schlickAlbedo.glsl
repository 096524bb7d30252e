// Single scattering reflected albedo of a GGX lobe with a generalized Schlick curve, exact but for
// the tables (and the curve's clamp at 0).
PATINA_FN vec3 schlickMoments(float mu, float alpha, SchlickFresnel s) {
    MomentPlace p = momentPlace(mu, alpha);
    float m0 = momentAlbedo0(p);
    float mp = m0 * momentMean(p, s.exponent);
    float m67 = m0 * (momentMean(p, 6.0f) - momentMean(p, 7.0f));
    return max(s.f0 * (m0 - mp) + s.f90 * mp - s.dip * m67, vec3(0.0f));
}

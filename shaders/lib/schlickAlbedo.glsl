// Single scattering reflected albedo of a GGX lobe with a generalized Schlick curve, exact but for
// the tables (and the curve's clamp at 0).
PATINA_FN vec3 schlickMoments(float mu, float alpha, SchlickFresnel s) {
    float m0 = momentAlbedoAt(mu, alpha, 0);
    float mp = min(momentAlbedo(mu, alpha, s.exponent), m0);
    float m67 = momentAlbedoAt(mu, alpha, 6) - momentAlbedoAt(mu, alpha, 7);
    return max(s.f0 * (m0 - mp) + s.f90 * mp - s.dip * m67, vec3(0.0f));
}

// SPDX-License-Identifier: Apache-2.0
// Chromatic dispersion: an ior for each wavelength.

// ior: at the d line (587.56 nm). abbeNumber: V = (n_d - 1) / (n_F - n_C), 0 for none. scale: of
// 1 / V, as OpenPBR 1.1 says ("Transparent dispersion"). nm: wavelength; 0 for light of no
// wavelength in particular, which sees the ior as it is. Cauchy's equation with two terms, n = A + B
// / nm^2, through the three lines (C: 656.27 nm, F: 486.13 nm). Extreme scales stay on the side of 1
// that the ior is on.
PATINA_FN float patternDispersedIor(float ior, float abbeNumber, float scale, float nm) {
    bool disperses = abbeNumber > 0.0f && scale > 0.0f && nm > 0.0f && ior > 0.0f;
    if (!disperses) return ior;
    float um = 0.001f * nm;
    // 1 / F^2 - 1 / C^2 and 1 / d^2, in 1 / um^2.
    float lines = (1.0f / (um * um) - 2.8966469f) / 1.9096539f;
    float n = ior + (ior - 1.0f) * scale / abbeNumber * lines;
    return select(max(n, 1.0f), clamp(n, 0.01f, 1.0f), ior > 1.0f);
}

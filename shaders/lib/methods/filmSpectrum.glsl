// SPDX-License-Identifier: Apache-2.0
// The choice point thinFilm: how interference is summed over the spectrum that a channel sees.

const int FILM_GAUSSIANS = 0; // each order through sums of Gaussians (film.glsl)
const int FILM_TABLED = 1;    // each order through tables of the same transforms
const int FILM_SPECTRAL = 2;  // all orders at once, wavelength by wavelength: truth

const int FILM_WAVELENGTHS = 144;
const float FILM_PATH_MAX = 16.0f; // um; the table ends there, where no channel has a phase left

PATINA_FN float filmWavelength(int j) {
    return 380.0f + (float(j) + 0.5f) * (400.0f / float(FILM_WAVELENGTHS));
}

PATINA_FN float filmHump(float nm, float centre, float below, float above) {
    float t = (nm - centre) / select(below, above, nm < centre);
    return exp2(-0.721347520f * t * t);
}

// Sensitivities of the linear Rec.709 channels to light of one wavelength in nm, not scaled: colour
// matching functions of Wyman, Sloan and Shirley 2013 (multi-lobe), as filmSensitivity.py has them.
PATINA_FN vec3 filmChannels(float nm) {
    float x = 1.056f * filmHump(nm, 599.8f, 37.9f, 31.0f) +
              0.362f * filmHump(nm, 442.0f, 16.0f, 26.7f) -
              0.065f * filmHump(nm, 501.1f, 20.4f, 26.2f);
    float y =
        0.821f * filmHump(nm, 568.8f, 46.9f, 40.5f) + 0.286f * filmHump(nm, 530.9f, 16.3f, 31.1f);
    float z =
        1.217f * filmHump(nm, 437.0f, 11.8f, 36.0f) + 0.681f * filmHump(nm, 459.0f, 26.0f, 13.8f);
    return vec3(3.2404542f * x - 1.5371385f * y - 0.4985314f * z,
                1.8760108f * y - 0.9692660f * x + 0.0415560f * z,
                0.0556434f * x - 0.2040259f * y + 1.0572252f * z);
}

// A channel's sensitivity, Fourier transformed at a path difference.
struct FilmSensitivity {
    vec3 re;
    vec3 im;
};

PATINA_FN FilmSensitivity filmEntry(int i) {
    int k = FILM_TABLE + 6 * i;
    FilmSensitivity s;
    s.re = vec3(albedoTableFetch(k), albedoTableFetch(k + 1), albedoTableFetch(k + 2));
    s.im = vec3(albedoTableFetch(k + 3), albedoTableFetch(k + 4), albedoTableFetch(k + 5));
    return s;
}

// phase: 2 PI times the path difference in um.
PATINA_FN FilmSensitivity filmTabled(float phase) {
    float t = min(phase / (TWO_PI * FILM_PATH_MAX), 1.0f);
    int i = tableCell(t, FILM_PATHS);
    float f = tableFraction(t, FILM_PATHS);
    FilmSensitivity a = filmEntry(i);
    FilmSensitivity b = filmEntry(i + 1);
    a.re = mix(a.re, b.re, f);
    a.im = mix(a.im, b.im, f);
    return a;
}

// SPDX-License-Identifier: Apache-2.0
// Interference in a thin layer on an interface: Airy's sum over the bounces inside the layer, seen
// by three broad channels (Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for
// the Modeling of Varying Iridescence"). Each order's term is the channel's sensitivity, Fourier
// transformed, at that order's path difference. The transforms are sums of Gaussians fitted to the
// linear Rec.709 sensitivities themselves by shaders/bake/filmSensitivity.py (within 0.011 of 1),
// so that a channel of the base meets its own phase. All three are scaled to 1 at path difference
// 0.

struct Film {
    float thickness; // nm, 0 = none
    float ior;
    int method; // FILM_*, FILM_GAUSSIANS unless the caller sets another
};

// Orders of the sum; what is left out shows only where both interfaces reflect nearly all.
const int FILM_ORDERS = 6;

// thickness: nm, clamped to [0, FILM_THICKNESS_MAX]; below FILM_THICKNESS_MIN there is no film.
// ior: relative to the medium outside, clamped to [1, FILM_IOR_MAX]; 1 is no film either.
PATINA_FN Film makeFilm(float thickness, float ior) {
    Film f;
    float d = clamp(thickness, 0.0f, FILM_THICKNESS_MAX);
    f.thickness = select(d, 0.0f, d >= FILM_THICKNESS_MIN);
    f.ior = clamp(ior, 1.0f, FILM_IOR_MAX);
    f.method = FILM_GAUSSIANS;
    return f;
}

PATINA_FN bool filmIsThere(Film f) {
    return PATINA_FILM(f.thickness > 0.0f);
}

// Path difference in nm by which grazing light and light along the normal may differ and still be followed by
// few cosines: a quarter of a wave.
const float FILM_SMOOTH_PATH = 140.0f;
PATINA_FN bool filmWaves(Film f) {
    float grazing = sqrt((f.ior - 1.0f) * (f.ior + 1.0f));
    return PATINA_FILM(2.0f * f.thickness * (f.ior - grazing) > FILM_SMOOTH_PATH);
}

// One Gaussian. phase: 2 PI times the path difference in um.
PATINA_FN vec2 filmTerm(float phase, float amplitude, float wavenumber, float width) {
    float w = width * phase;
    float a = amplitude * exp2(-1.44269504f * w * w);
    return vec2(a * cos(wavenumber * phase), a * sin(wavenumber * phase));
}

PATINA_FN FilmSensitivity filmSensitivity(float phase) {
    vec2 r = filmTerm(phase, 1.329794f, 1.637757f, 0.050146f) +
             filmTerm(phase, -0.922910f, 1.827166f, 0.103258f) +
             filmTerm(phase, 0.075492f, 2.274231f, 0.053023f) +
             filmTerm(phase, 0.517624f, 1.753614f, 0.049741f);
    vec2 g = filmTerm(phase, -0.302636f, 1.631828f, 0.049205f) +
             filmTerm(phase, -0.101721f, 2.258642f, 0.061259f) +
             filmTerm(phase, 1.336987f, 1.816428f, 0.091630f) +
             filmTerm(phase, 0.067370f, 1.886025f, 0.035802f);
    vec2 b = filmTerm(phase, 0.249520f, 2.297376f, 0.039932f) +
             filmTerm(phase, -0.163790f, 1.812252f, 0.081073f) +
             filmTerm(phase, 0.246936f, 2.173304f, 0.042756f) +
             filmTerm(phase, 0.667334f, 2.189819f, 0.089651f);
    FilmSensitivity s;
    s.re = vec3(r.x, g.x, b.x);
    s.im = vec3(r.y, g.y, b.y);
    return s;
}

// Amplitudes reflected at the base, light arriving through the film: s in xy, p in zw (real,
// imaginary). ec: film ior times cosine in the film; s2: squared sine outside; n + i k: the base.
PATINA_FN vec4 filmBase(float ec, float e2, float s2, float n, float k) {
    // (n + i k) cos = a + i b: the root of (n + i k)^2 - s2 with a, b >= 0.
    float re = (n - k) * (n + k) - s2;
    float im = 2.0f * n * k;
    float len = sqrt(re * re + im * im);
    float a = safeSqrt(0.5f * (len + re));
    float b = safeSqrt(0.5f * (len - re));
    // s: (ec - a - ib) / (ec + a + ib).
    float ds = max(sqr(ec + a) + b * b, TINY);
    float sr = (ec * ec - a * a - b * b) / ds;
    float si = -2.0f * ec * b / ds;
    // p: (N^2 ec - e^2 (a + ib)) / (N^2 ec + e^2 (a + ib)).
    float ur = ((n - k) * (n + k)) * ec;
    float ui = im * ec;
    float vr = e2 * a;
    float vi = e2 * b;
    float dp = max(sqr(ur + vr) + sqr(ui + vi), TINY);
    float pr = (ur * ur + ui * ui - vr * vr - vi * vi) / dp;
    float pi = 2.0f * (ui * vr - ur * vi) / dp;
    return vec4(sr, si, pr, pi);
}

// Reflectance of one polarisation. r12: amplitude at the film's surface; (r, i): that at the base
// per channel. Adds the orders with powers of q = -r12 (r + i i).
struct FilmSum {
    vec3 constant; // without interference
    vec3 factor;   // on each order
    vec3 qr;
    vec3 qi;
};

PATINA_FN FilmSum filmSum(float r12, vec3 r, vec3 i) {
    float a = r12 * r12;
    float t = 1.0f - a;
    vec3 b = r * r + i * i;
    vec3 rs = b * (t * t) / max(vec3(1.0f) - b * a, vec3(TINY));
    FilmSum s;
    s.constant = vec3(a) + rs;
    s.factor = rs - vec3(t);
    s.qr = r * -r12;
    s.qi = i * -r12;
    return s;
}

PATINA_FN FilmSensitivity filmSensitivityBy(int method, float phase) {
    if (method == FILM_TABLED) return filmTabled(phase);
    return filmSensitivity(phase);
}

// Reflectance of one polarisation at one phase (cos, sin): all orders at once.
PATINA_FN vec3 filmAiry(float r12, vec3 r, vec3 i, vec2 phase) {
    vec3 re = r * phase.x - i * phase.y;
    vec3 im = r * phase.y + i * phase.x;
    vec3 above = (vec3(r12) + re) * (vec3(r12) + re) + im * im;
    vec3 below = (vec3(1.0f) + re * r12) * (vec3(1.0f) + re * r12) + im * im * (r12 * r12);
    return above / max(below, vec3(TINY));
}

// The method FILM_SPECTRAL: Airy's formula at many wavelengths. x, y, z: filmBase per channel.
PATINA_FN_RARE vec3 filmSpectral(float path, float s12, float p12, vec4 x, vec4 y, vec4 z) {
    vec3 sum = vec3(0.0f);
    vec3 white = vec3(0.0f);
    for (int j = 0; j < FILM_WAVELENGTHS; ++j) {
        float nm = filmWavelength(j);
        float phase = TWO_PI * path / nm;
        vec2 turn = vec2(cos(phase), sin(phase));
        vec3 seen = filmChannels(nm);
        vec3 rs = filmAiry(s12, vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y), turn);
        vec3 rp = filmAiry(p12, vec3(x.z, y.z, z.z), vec3(x.w, y.w, z.w), turn);
        sum += seen * (rs + rp) * 0.5f;
        white += seen;
    }
    return min(max(sum / white, vec3(0.0f)), vec3(1.0f));
}

// Reflectance of the coated interface from outside at cosine c, for a base of complex ior n + i k.
PATINA_FN vec3 filmReflectance(Film film, float c, vec3 n, vec3 k) {
    float e = film.ior;
    float s2 = 1.0f - c * c;
    float ct = safeSqrt(1.0f - s2 / (e * e));
    float ec = e * ct;
    float s12 = (c - ec) / max(c + ec, TINY);
    float p12 = (e * c - ct) / max(e * c + ct, TINY);
    vec4 x = filmBase(ec, e * e, s2, n.x, k.x);
    vec4 y = filmBase(ec, e * e, s2, n.y, k.y);
    vec4 z = filmBase(ec, e * e, s2, n.z, k.z);
    int method = PATINA_FILM_METHOD(film.method);
    if (method == FILM_SPECTRAL)
        return filmSpectral(2.0f * film.thickness * ec, s12, p12, x, y, z);
    FilmSum s = filmSum(s12, vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y));
    FilmSum p = filmSum(p12, vec3(x.z, y.z, z.z), vec3(x.w, y.w, z.w));
    float phase = TWO_PI * 2e-3f * film.thickness * ec;
    vec3 sr = s.qr;
    vec3 si = s.qi;
    vec3 pr = p.qr;
    vec3 pi = p.qi;
    vec3 sum = s.constant + p.constant;
    for (int m = 1; m <= FILM_ORDERS; ++m) {
        FilmSensitivity f = filmSensitivityBy(method, float(m) * phase);
        sum +=
            s.factor * (sr * f.re - si * f.im) * 2.0f + p.factor * (pr * f.re - pi * f.im) * 2.0f;
        vec3 nextS = sr * s.qr - si * s.qi;
        si = sr * s.qi + si * s.qr;
        sr = nextS;
        vec3 nextP = pr * p.qr - pi * p.qi;
        pi = pr * p.qi + pi * p.qr;
        pr = nextP;
    }
    return min(max(sum * 0.5f, vec3(0.0f)), vec3(1.0f));
}

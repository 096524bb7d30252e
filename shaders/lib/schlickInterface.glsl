// SPDX-License-Identifier: Apache-2.0
// The interface of shaders/lobes/generalizedSchlick.glsl: its curve, alone or under a film. Also
// the coloured reflectance of dielectric_bsdf under a thin film, since dielectric.glsl has one
// number.
//
// Sides and flux form as in dielectric.glsl. The ior that bends T follows from the mean of color0.
// From the inside the curve is read at the cosine on the outside, and total internal reflection is
// 1, so that R and T stay reciprocal in the sense of dielectric.glsl.

struct SchlickLobe {
    SchlickFresnel fresnel;
    Film film;
    vec3 filmBase; // ior of the base under the film, per channel
    vec3 tint;
    vec3 favg;
    vec2 alpha; // 0 = mirror
    float ior;
    float invIor;
    float retro; // -1 sends reflection back to where it came from, else 1
    int mode;
    int compensate;
    int ndf;      // NDF_GGX, NDF_BECKMANN
    int albedo;   // ALBEDO_*, by schlickMethods as the next
    int sampling; // SAMPLING_VNDF and others
    bool exact;   // a dielectric under a film, not Schlick's curve
    bool sharedInterface;
    bool deltaT; // refraction too narrow to evaluate
    bool known;  // kr and kt are those of the wo at hand (schlickAt)
    vec3 kr;     // factors on R and T, see energy.glsl
    vec3 kt;
};

// color0, color90: reflectance at normal and grazing incidence, in [0, 1]. color82: factor on the
// reflectance at 82 degrees, 1 = off. exponent: 5 is Schlick's. Other inputs as in dielectricSetup.
// Colours above 1 are clamped.
PATINA_FN SchlickLobe schlickSetup(vec3 color0, vec3 color82, vec3 color90, float exponent,
                                   vec2 roughness, bool retroreflective, int scatterMode,
                                   bool sharedInterface, int compensate) {
    SchlickLobe l;
    l.fresnel = schlickFresnel(color0, color82, color90, exponent);
    l.favg = fresnelSchlickAverage(l.fresnel);
    l.alpha = ggxAlpha(roughness);
    float r = sqrt(min(lobeMean(l.fresnel.f0), F0_MAX));
    float n = (1.0f + r) / (1.0f - r);
    l.ior = select(1.0f, n, n - 1.0f < IOR_MATCHED);
    l.invIor = 1.0f / l.ior;
    l.retro = select(-1.0f, 1.0f, retroreflective);
    l.mode = scatterMode;
    l.compensate = compensate;
    l.ndf = NDF_GGX;
    l.albedo = ALBEDO_TABLE;
    l.sampling = SAMPLING_VNDF;
    l.sharedInterface = sharedInterface && scatterMode == SCATTER_T;
    l.deltaT = min(l.alpha.x, l.alpha.y) * (l.ior - 1.0f) < REFRACTION_DELTA * l.ior;
    l.known = false;
    l.exact = false;
    l.film = makeFilm(0.0f, 1.0f);
    l.filmBase = vec3(1.0f);
    l.tint = vec3(1.0f);
    l.kr = vec3(1.0f);
    l.kt = vec3(1.0f);
    return l;
}

// The lobe with other methods (ALBEDO_*, SAMPLING_VNDF and others, FILM_*), after its film.
PATINA_FN SchlickLobe schlickMethods(SchlickLobe l, int albedo, int sampling, int film) {
    l.albedo = albedo;
    l.sampling = sampling;
    l.film.method = film;
    return l;
}

// The bare dielectric that a film lobe is built on.
PATINA_FN vec3 schlickBare(vec3 n, float c) {
    return vec3(fresnelDielectric(c, n.x), fresnelDielectric(c, n.y), fresnelDielectric(c, n.z));
}

// Reflectance from outside at cosine c. A film under Schlick's curve scales what is not reflected as
// it does for a dielectric of the same color0: the curve itself knows no phases, and a base that
// reflects all does so under any film.
PATINA_FN vec3 schlickOutside(SchlickLobe l, float c) {
    vec3 curve = min(fresnelSchlick(c, l.fresnel), vec3(1.0f));
    if (!filmIsThere(l.film)) {
        if (PATINA_FILM(l.exact)) return schlickBare(l.filmBase, c);
        return curve;
    }
    vec3 coated = filmReflectance(l.film, c, l.filmBase, vec3(0.0f));
    if (PATINA_FILM(l.exact)) return coated;
    vec3 passed = max(vec3(1.0f) - schlickBare(l.filmBase, c), vec3(TINY));
    return max(vec3(1.0f) - (vec3(1.0f) - curve) * (vec3(1.0f) - coated) / passed, vec3(0.0f));
}

PATINA_FN vec3 schlickAverage(SchlickLobe l) {
    vec3 sum = vec3(0.0f);
    for (int j = 0; j < 3; ++j)
        sum += schlickOutside(l, gaussCos(j)) * gaussShare(j);
    return sum;
}

// The lobe under a film (makeFilm).
PATINA_FN SchlickLobe schlickFilm(SchlickLobe l, float thickness, float ior) {
    l.film = makeFilm(thickness, ior);
    vec3 r = sqrt(min(l.fresnel.f0, vec3(FILM_BASE_F0_MAX)));
    l.filmBase = (vec3(1.0f) + r) / (vec3(1.0f) - r);
    if (filmIsThere(l.film)) l.favg = schlickAverage(l);
    return l;
}

// A dielectric under a film; inputs as in dielectricSetup and makeFilm. ior 0 reflects all.
PATINA_FN SchlickLobe filmDielectricSetup(vec3 tint, float ior, vec2 roughness, float thickness,
                                          float filmIor, bool retroreflective, int scatterMode,
                                          bool sharedInterface, int compensate) {
    bool off = !(ior > 0.0f);
    SchlickLobe l = schlickSetup(
        vec3(select(0.0f, select(0.0f, 1.0f, scatterMode == SCATTER_T), off)), vec3(1.0f),
        vec3(1.0f), 5.0f, roughness, retroreflective, scatterMode, sharedInterface, compensate);
    l.tint = lobeColor(tint);
    if (off) return l;
    l.exact = true;
    float n = clamp(ior, 1.0f / IOR_MAX, IOR_MAX);
    l.ior = select(n, 1.0f, abs(n - 1.0f) >= IOR_MATCHED);
    l.invIor = 1.0f / l.ior;
    l.filmBase = vec3(l.ior);
    l.film = makeFilm(thickness, filmIor);
    l.favg = schlickAverage(l);
    l.deltaT = min(l.alpha.x, l.alpha.y) * abs(l.ior - 1.0f) < REFRACTION_DELTA * max(l.ior, 1.0f);
    return l;
}

PATINA_FN float schlickEta(SchlickLobe l, float z) {
    return select(l.ior, l.invIor, z >= 0.0f);
}

PATINA_FN vec3 schlickReflectance(SchlickLobe l, float c, float eta) {
    float ct = cosRefracted(c, eta);
    vec3 f = schlickOutside(l, select(c, ct, eta == l.ior));
    return select(vec3(1.0f), f, eta < 1.0f && ct <= 0.0f);
}

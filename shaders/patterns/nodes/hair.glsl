// SPDX-License-Identifier: Apache-2.0
// Nodes that turn what is known of hair into the inputs of chiang_hair_bsdf.
#ifndef PATINA_NODE_ROWS

PATINA_FN float hairBetween(float x, float low, float high) {
    return x > low ? min(x, high) : low;
}
// Black and NaN are nearly black.
PATINA_FN float hairDepth(float transmittance) {
    return -log(hairBetween(transmittance, 1e-4f, 1.0f));
}

// Chiang et al. 2016, eq. 7 and 8: perceptually even roughness to variance and logistic scale.
PATINA_FN vec2 nodeHairRoughness(float longitudinal, float azimuthal, float scaleTT, float scaleTRT,
                                 PATINA_OUT(vec2) tt, PATINA_OUT(vec2) trt) {
    float l = hairBetween(longitudinal, 1e-3f, 1.0f);
    float a = hairBetween(azimuthal, 1e-3f, 1.0f);
    float root = 0.726f * l + 0.812f * l * l + 3.7f * pow(l, 20.0f);
    float v = root * root;
    float s = 0.265f * a + 1.194f * a * a + 5.372f * pow(a, 22.0f);
    tt = vec2(v * scaleTT * scaleTT, s);
    trt = vec2(v * scaleTRT * scaleTRT, s);
    return vec2(v, s);
}

PATINA_FN float hairAbsorption(float color, float scale) {
    float x = log(hairBetween(color, 1e-3f, 1.0f)) / scale;
    return x * x;
}
// Chiang et al. 2016, eq. 9: the absorption for which many hairs look like the colour.
PATINA_FN vec3 nodeHairFromColor(vec3 color, float azimuthal) {
    float b = hairBetween(azimuthal, 0.0f, 1.0f);
    float scale = 5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + b * 0.245f))));
    return vec3(hairAbsorption(color.x, scale), hairAbsorption(color.y, scale),
                hairAbsorption(color.z, scale));
}

PATINA_FN float hairPigments(float melanin, float red, float eumelanin, float pheomelanin) {
    return melanin * ((1.0f - red) * hairDepth(eumelanin) + red * hairDepth(pheomelanin));
}
// d'Eon et al. 2011, section 6.1, with the concentrations of both pigments as MaterialX has them.
PATINA_FN vec3 nodeHairFromMelanin(float concentration, float redness, vec3 eumelanin,
                                   vec3 pheomelanin) {
    float melanin = -log(max(1.0f - hairBetween(concentration, 0.0f, 1.0f), 1e-4f));
    float red = hairBetween(redness, 0.0f, 1.0f);
    return vec3(hairPigments(melanin, red, eumelanin.x, pheomelanin.x),
                hairPigments(melanin, red, eumelanin.y, pheomelanin.y),
                hairPigments(melanin, red, eumelanin.z, pheomelanin.z));
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

const NodeRow rows[] = {
    {"ND_chiang_hair_roughness", "chiang_hair_roughness",
     "float longitudinal=0.1, float azimuthal=0.2, float scale_TT=0.5, float scale_TRT=2",
     "vector2 roughness_R, vector2 roughness_TT, vector2 roughness_TRT",
     PATINA_PATTERN(nodeHairRoughness)},
    {"ND_chiang_hair_absorption_from_color", "chiang_hair_absorption_from_color",
     "color3 color=1, float azimuthal_roughness=0.2", "vector3 absorption",
     PATINA_PATTERN(nodeHairFromColor)},
    {"ND_deon_hair_absorption_from_melanin", "deon_hair_absorption_from_melanin",
     "float melanin_concentration=0.25, float melanin_redness=0.5, "
     "color3 eumelanin_color=0.657704 0.498077 0.254107, "
     "color3 pheomelanin_color=0.829444 0.670320 0.349938",
     "vector3 absorption", PATINA_PATTERN(nodeHairFromMelanin)},
};

#endif

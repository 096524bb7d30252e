// SPDX-License-Identifier: Apache-2.0
// Nodes that turn what is known of hair into the inputs of chiang_hair_bsdf.
#include "materialNetwork/nodes/nodeTable.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using glm::vec4;
using Call = const PatternCall&;

float between(float x, float lo, float hi) {
    return x > lo ? std::min(x, hi) : lo;
}

/// Natural logarithm of a transmittance, with black and NaN as nearly black.
float opticalDepth(float transmittance) {
    return -std::log(between(transmittance, 1e-4f, 1.0f));
}

/// Chiang et al. 2016, eq. 7 and 8: perceptually even roughness to variance and logistic scale.
constexpr char roughnessGlsl[] =
    "nodeHairRoughness($0.x, $1.x, 1.0); nodeHairRoughness($0.x, $1.x, $2.x); "
    "nodeHairRoughness($0.x, $1.x, $3.x)";
constexpr Pattern roughness = rarePattern(roughnessGlsl, [](Call c) {
    const float longitudinal = between(c.x(0), 1e-3f, 1.0f),
                azimuthal = between(c.x(1), 1e-3f, 1.0f);
    const float root = 0.726f * longitudinal + 0.812f * longitudinal * longitudinal +
                       3.7f * std::pow(longitudinal, 20.0f);
    const float v = root * root;
    const float s =
        0.265f * azimuthal + 1.194f * azimuthal * azimuthal + 5.372f * std::pow(azimuthal, 22.0f);
    c.out(0) = vec4(v, s, 0.0f, 0.0f);
    c.out(1) = vec4(v * c.x(2) * c.x(2), s, 0.0f, 0.0f);
    c.out(2) = vec4(v * c.x(3) * c.x(3), s, 0.0f, 0.0f);
});

/// Chiang et al. 2016, eq. 9: the absorption for which many hairs look like the colour.
constexpr Pattern absorptionFromColor = rarePattern("nodeHairFromColor($0, $1.x)", [](Call c) {
    const float b = between(c.x(1), 0.0f, 1.0f);
    const float scale =
        5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + b * 0.245f))));
    vec4 sigma(0.0f);
    for (int i = 0; i < 3; ++i) {
        const float x = std::log(between(c.in(0)[i], 1e-3f, 1.0f)) / scale;
        sigma[i] = x * x;
    }
    c.out() = sigma;
});

/// d'Eon et al. 2011, section 6.1, with the concentrations of both pigments as MaterialX has them.
constexpr char absorptionFromMelaninGlsl[] = "nodeHairFromMelanin($0.x, $1.x, $2, $3)";
constexpr Pattern absorptionFromMelanin = rarePattern(absorptionFromMelaninGlsl, [](Call c) {
    const float melanin = -std::log(std::max(1.0f - between(c.x(0), 0.0f, 1.0f), 1e-4f));
    const float red = between(c.x(1), 0.0f, 1.0f);
    vec4 sigma(0.0f);
    for (int i = 0; i < 3; ++i)
        sigma[i] =
            melanin * ((1.0f - red) * opticalDepth(c.in(2)[i]) + red * opticalDepth(c.in(3)[i]));
    c.out() = sigma;
});

const NodeRow rows[] = {
    {"ND_chiang_hair_roughness", "chiang_hair_roughness",
     "float longitudinal=0.1, float azimuthal=0.2, float scale_TT=0.5, float scale_TRT=2",
     "vector2 roughness_R, vector2 roughness_TT, vector2 roughness_TRT", roughness},
    {"ND_chiang_hair_absorption_from_color", "chiang_hair_absorption_from_color",
     "color3 color=1, float azimuthal_roughness=0.2", "vector3 absorption", absorptionFromColor},
    {"ND_deon_hair_absorption_from_melanin", "deon_hair_absorption_from_melanin",
     "float melanin_concentration=0.25, float melanin_redness=0.5, "
     "color3 eumelanin_color=0.657704 0.498077 0.254107, "
     "color3 pheomelanin_color=0.829444 0.670320 0.349938",
     "vector3 absorption", absorptionFromMelanin},
};

} // namespace

NodeRows hairNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

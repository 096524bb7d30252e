// SPDX-License-Identifier: Apache-2.0
// Nodes that turn what is known of hair into the inputs of chiang_hair_bsdf.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/hair.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

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

} // namespace

NodeRows hairNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

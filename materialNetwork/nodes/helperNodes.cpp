// SPDX-License-Identifier: Apache-2.0
// Nodes that turn artistic parameters into those of lobes.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/helper.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

const NodeRow rows[] = {
    {"ND_roughness_anisotropy", "roughness_anisotropy", "float roughness=0, float anisotropy=0",
     "vector2", PATINA_PATTERN(patternRoughnessAnisotropy)},
    {"ND_roughness_dual", "roughness_dual", "vector2 roughness=0", "vector2",
     PATINA_PATTERN(patternRoughnessDual)},
    {"ND_glossiness_anisotropy", "glossiness_anisotropy", "float glossiness=1, float anisotropy=0",
     "vector2", PATINA_PATTERN(nodeGlossinessAnisotropy)},
    {"ND_artistic_ior", "artistic_ior",
     "color3 reflectivity=0.944 0.776 0.373, color3 edge_color=0.998 0.981 0.751",
     "color3 ior, color3 extinction", PATINA_PATTERN(nodeArtisticIor)},
    {"ND_blackbody", "blackbody", "float temperature=5000", "color3",
     PATINA_PATTERN(patternBlackbody)},
    {"ND_patina_dispersed_ior", "patina_dispersed_ior",
     "float ior=1.5, float abbe_number=0, float scale=1", "float", PATINA_PATTERN(nodeDispersedIor),
     Algebra::Disperse},
    {"ND_isuniform_$", "isuniform", "$ in=0", "float", PATINA_PATTERN(nodeIsUniform),
     Algebra::IsUniform, "float color3"},
};

} // namespace

NodeRows helperNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

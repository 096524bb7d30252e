// SPDX-License-Identifier: Apache-2.0
// Hex-tiled images: a texture repeated without visible repetition.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/hexTile.glsl"
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_HEX                                                                                 \
    "vector2 texcoord=@UV0, vector2 tiling=1, float rotation=1, vector2 rotationrange=0 360, "     \
    "float scale=1, vector2 scalerange=0.5 2, float offset=1, vector2 offsetrange=0 1, "           \
    "float falloff=0.5, "

const NodeRow rows[] = {
    {"ND_hextiledimage_$", "hextiledimage",
     "filename file=, $ default=0, " PATINA_HEX
     "float falloffcontrast=0.5, color3 lumacoeffs=0.2722287 0.6740818 0.0536895",
     "$", PATINA_PATTERN(nodeHexImage), Algebra::None, "color3 color4", prepareImage},
    {"ND_hextilednormalmap_vector3", "hextilednormalmap",
     "filename file=, vector3 default=0.5 0.5 1, " PATINA_HEX
     "float strength=1, boolean flip_g=0, vector3 normal=@Nworld, vector3 tangent=@Tworld, "
     "vector3 bitangent=@Bworld",
     "vector3", PATINA_PATTERN(nodeHexNormalMap), Algebra::None, nullptr, prepareImage},
};

} // namespace

NodeRows hexTileNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

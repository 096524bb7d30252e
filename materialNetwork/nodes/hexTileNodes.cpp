// SPDX-License-Identifier: Apache-2.0
// Hex-tiled images: a texture repeated without visible repetition.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/hexTile.glsl"
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows hexTileNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

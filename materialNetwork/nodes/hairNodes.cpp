// SPDX-License-Identifier: Apache-2.0
// Nodes that turn what is known of hair into the inputs of chiang_hair_bsdf.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/hair.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows hairNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
// Nodes that turn artistic parameters into those of lobes.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/helper.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows helperNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

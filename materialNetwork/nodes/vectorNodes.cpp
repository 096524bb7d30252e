// SPDX-License-Identifier: Apache-2.0
// Nodes that look at a vector as a whole.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/vector.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows vectorNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
// Nodes that take values apart, put them together and change their type.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/channel.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows channelNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

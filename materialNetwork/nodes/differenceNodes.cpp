// SPDX-License-Identifier: Apache-2.0
// Nodes that need their input at neighbouring points. Graphs are evaluated at one point, so the
// part of the graph that makes their input is copied, with the texture coordinates and
// positions that it reads moved a little (materialNetwork/graph/differences.h).
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/difference.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows differenceNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

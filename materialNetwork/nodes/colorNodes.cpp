// SPDX-License-Identifier: Apache-2.0
// Adjustments of colours, and compositing.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/color.glsl"
#include "materialNetwork/nodes/patternFunctions.h"
#include "materialNetwork/nodes/nodeTable.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows colorNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
// Shapes, tilings, ramps and splits of the plane.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/shape.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows shapeNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

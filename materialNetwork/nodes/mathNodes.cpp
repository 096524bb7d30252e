// SPDX-License-Identifier: Apache-2.0
// Arithmetic, component by component. Scalars fill their register, so one function serves all
// sizes and the scalar-vector variants.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/math.glsl"
#include "materialNetwork/nodes/patternFunctions.h"
#include "materialNetwork/nodes/nodeTable.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows mathNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

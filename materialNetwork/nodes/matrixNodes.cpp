// SPDX-License-Identifier: Apache-2.0
// Matrices, one register per row.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/matrix.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows matrixNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

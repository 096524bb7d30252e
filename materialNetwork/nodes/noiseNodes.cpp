// SPDX-License-Identifier: Apache-2.0
// Noise and random numbers.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/noise.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows noiseNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

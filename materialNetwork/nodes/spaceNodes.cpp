// SPDX-License-Identifier: Apache-2.0
// Nodes that bring points, vectors and normals from one space to another, and what belongs to the
// frame and the view.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/space.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

void prepareSpaces(PatternSetup& setup, PatternData& data) {
    const auto world = [&](const char* input) {
        const std::string space = setup.text(input);
        return space != "object" && space != "model";
    };
    const bool from = world("fromspace"), to = world("tospace");
    data.mode = from == to ? sh::SPACE_KEPT : to ? sh::SPACE_TO_WORLD : sh::SPACE_TO_OBJECT;
}

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows spaceNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

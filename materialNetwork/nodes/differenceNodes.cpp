// SPDX-License-Identifier: Apache-2.0
// Nodes that need their input at neighbouring points. Graphs are evaluated at one point, so the
// part of the graph that makes their input is copied, with the texture coordinates and
// positions that it reads moved a little (materialNetwork/graph/differences.h).
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/difference.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

const NodeRow rows[] = {
    {"ND_heighttonormal_vector3", "heighttonormal",
     "float in=0, float scale=1, vector2 texcoord=@UV0", "vector3", PATINA_PATTERN(nodeFlat)},
    {"ND_blur_$", "blur", "$ in=0, float size=0, string filtertype=box", "$",
     PATINA_PATTERN(patternSame), Algebra::None, allTypes},
    {"PatinaShiftTexcoord_$", "shift_texcoord", "$ in=0, float axis=0", "$",
     PATINA_PATTERN(nodeShiftTexcoord), Algebra::None, "vector2 vector3"},
    {"PatinaShiftPosition", "shift_position", "vector3 in=0, float axis=0, float world=0",
     "vector3", PATINA_PATTERN(nodeShiftPosition)},
    {"PatinaMoveTexcoord_$", "move_texcoord",
     "$ in=0, float size=0, float blur=0, float tap=0, float gaussian=0", "$",
     PATINA_PATTERN(nodeMoveTexcoord), Algebra::None, "vector2 vector3"},
    {"PatinaMovePosition", "move_position",
     "vector3 in=0, float size=0, float blur=0, float tap=0, float gaussian=0, float world=0",
     "vector3", PATINA_PATTERN(nodeMovePosition)},
    {"PatinaSlope", "slope",
     "float here=0, float along_u=0, float along_v=0, float scale=1, "
     "vector2 texcoord=0, vector2 texcoord_u=0, vector2 texcoord_v=0",
     "vector3", PATINA_PATTERN(nodeSlope)},
};

} // namespace

NodeRows differenceNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

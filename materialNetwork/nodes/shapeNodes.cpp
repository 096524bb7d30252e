// SPDX-License-Identifier: Apache-2.0
// Shapes, tilings, ramps and splits of the plane.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/shape.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

#define PATINA_SHAPE "vector2 texcoord=@UV0, vector2 center=0, float radius=0.5"
#define PATINA_TILES(amount)                                                                       \
    "vector2 texcoord=@UV0, vector2 uvtiling=1, vector2 uvoffset=0, float " amount                 \
    ", boolean staggered=0"
#define PATINA_STOP(n) ", float interval" n "=1, color4 color" n "=1"

const NodeRow rows[] = {
    {"ND_circle_float", "circle", PATINA_SHAPE, "float", PATINA_PATTERN(nodeCircle)},
    {"ND_cloverleaf_float", "cloverleaf", PATINA_SHAPE, "float", PATINA_PATTERN(nodeCloverleaf)},
    {"ND_hexagon_float", "hexagon", PATINA_SHAPE, "float", PATINA_PATTERN(nodeHexagon)},
    {"ND_line_float", "line",
     "vector2 texcoord=@UV0, vector2 center=0, float radius=0.1, vector2 point1=0.25, "
     "vector2 point2=0.75",
     "float", PATINA_PATTERN(nodeLine)},
    {"ND_grid_color3", "grid", PATINA_TILES("thickness=0.05"), "color3", PATINA_PATTERN(nodeGrid)},
    {"ND_crosshatch_color3", "crosshatch", PATINA_TILES("thickness=0.05"), "color3",
     PATINA_PATTERN(nodeCrosshatch)},
    {"ND_tiledcircles_color3", "tiledcircles", PATINA_TILES("size=0.5"), "color3",
     PATINA_PATTERN(nodeTiledCircles)},
    {"ND_tiledcloverleafs_color3", "tiledcloverleafs", PATINA_TILES("size=0.5"), "color3",
     PATINA_PATTERN(nodeTiledCloverleafs)},
    {"ND_tiledhexagons_color3", "tiledhexagons", PATINA_TILES("size=0.5"), "color3",
     PATINA_PATTERN(nodeTiledHexagons)},
    {"ND_checkerboard_color3", "checkerboard",
     "color3 color1=1, color3 color2=0, vector2 uvtiling=8, vector2 uvoffset=0, "
     "vector2 texcoord=@UV0",
     "color3", PATINA_PATTERN(nodeCheckerboard)},
    {"ND_ramp", "ramp",
     "vector2 texcoord=@UV0, integer type=0, integer interpolation=1, integer num_intervals=2, "
     "float interval1=0, color4 color1=0 0 0 1" PATINA_STOP("2") PATINA_STOP("3") PATINA_STOP("4")
         PATINA_STOP("5") PATINA_STOP("6") PATINA_STOP("7") PATINA_STOP("8") PATINA_STOP("9")
             PATINA_STOP("10"),
     "color4", PATINA_PATTERN(nodeRamp)},
    {"ND_ramp_gradient", "ramp_gradient",
     "float x=0, float interval1=0, float interval2=1, color4 color1=0 0 0 1, color4 color2=1, "
     "integer interpolation=1, color4 prev_color=0 0 0 1, integer interval_num=1, "
     "integer num_intervals=2",
     "color4", PATINA_PATTERN(nodeRampGradient)},
    {"ND_ramplr_$", "ramplr", "$ valuel=0, $ valuer=0, vector2 texcoord=@UV0", "$",
     PATINA_PATTERN(nodeRampLeftRight), Algebra::None, allTypes},
    {"ND_ramptb_$", "ramptb", "$ valuet=0, $ valueb=0, vector2 texcoord=@UV0", "$",
     PATINA_PATTERN(nodeRampTopBottom), Algebra::None, allTypes},
    {"ND_ramp4_$", "ramp4",
     "$ valuetl=0, $ valuetr=0, $ valuebl=0, $ valuebr=0, vector2 texcoord=@UV0", "$",
     PATINA_PATTERN(nodeRamp4), Algebra::None, allTypes},
    {"ND_splitlr_$", "splitlr", "$ valuel=0, $ valuer=0, float center=0.5, vector2 texcoord=@UV0",
     "$", PATINA_PATTERN(nodeSplitLeftRight), Algebra::None, allTypes},
    {"ND_splittb_$", "splittb", "$ valuet=0, $ valueb=0, float center=0.5, vector2 texcoord=@UV0",
     "$", PATINA_PATTERN(nodeSplitTopBottom), Algebra::None, allTypes},
};

} // namespace

NodeRows shapeNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

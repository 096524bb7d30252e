// SPDX-License-Identifier: Apache-2.0
// Shapes, tilings, ramps and splits of the plane.
#ifndef PATINA_NODE_ROWS

PATINA_FN float nodeCircle(vec2 uv, vec2 center, float radius) {
    return patternShape(0, uv - center, radius);
}
PATINA_FN float nodeCloverleaf(vec2 uv, vec2 center, float radius) {
    return patternShape(1, uv - center, radius);
}
PATINA_FN float nodeHexagon(vec2 uv, vec2 center, float radius) {
    return patternShape(2, uv - center, radius);
}
PATINA_FN float nodeLine(vec2 uv, vec2 center, float radius, vec2 a, vec2 b) {
    return patternLine(uv - center, a, b, radius);
}

PATINA_FN float nodeGrid(vec2 uv, vec2 tiling, vec2 offset, float thickness, bool staggered) {
    return patternGrid(patternTile(uv, tiling, offset), thickness, staggered);
}
PATINA_FN float nodeCrosshatch(vec2 uv, vec2 tiling, vec2 offset, float thickness, bool staggered) {
    return patternCrosshatch(patternTile(uv, tiling, offset), thickness, staggered);
}
// Cloverleaves are staggered in squares, the others as densely as circles are packed.
PATINA_FN float nodeTiledCircles(vec2 uv, vec2 tiling, vec2 offset, float size, bool staggered) {
    return patternTiledShape(0, patternTile(uv, tiling, offset), size, staggered, 0.866025f);
}
PATINA_FN float nodeTiledCloverleafs(vec2 uv, vec2 tiling, vec2 offset, float size,
                                     bool staggered) {
    return patternTiledShape(1, patternTile(uv, tiling, offset), size, staggered, 0.5f);
}
PATINA_FN float nodeTiledHexagons(vec2 uv, vec2 tiling, vec2 offset, float size, bool staggered) {
    return patternTiledShape(2, patternTile(uv, tiling, offset), size, staggered, 0.866025f);
}
PATINA_FN vec4 nodeCheckerboard(vec4 odd, vec4 even, vec2 tiling, vec2 offset, vec2 uv) {
    return even + (odd - even) * patternChecker(patternTile(uv, tiling, offset));
}

PATINA_FN vec4 nodeRamp(vec2 uv, int kind, int interpolation, int count, float at0, vec4 c0,
                        float at1, vec4 c1, float at2, vec4 c2, float at3, vec4 c3, float at4,
                        vec4 c4, float at5, vec4 c5, float at6, vec4 c6, float at7, vec4 c7,
                        float at8, vec4 c8, float at9, vec4 c9) {
    float at[10];
    at[0] = at0;
    at[1] = at1;
    at[2] = at2;
    at[3] = at3;
    at[4] = at4;
    at[5] = at5;
    at[6] = at6;
    at[7] = at7;
    at[8] = at8;
    at[9] = at9;
    vec4 colors[10];
    colors[0] = c0;
    colors[1] = c1;
    colors[2] = c2;
    colors[3] = c3;
    colors[4] = c4;
    colors[5] = c5;
    colors[6] = c6;
    colors[7] = c7;
    colors[8] = c8;
    colors[9] = c9;
    float x = patternRampPosition(uv, kind);
    vec4 color = c0;
    int stretches = min(max(count - 1, 0), 9);
    for (int i = 0; i < stretches; ++i) {
        if (x <= at[i]) continue;
        float t = patternRampBlend(x, at[i], at[i + 1], interpolation);
        color = colors[i] + (colors[i + 1] - colors[i]) * t;
    }
    return color;
}
// One stretch of a ramp, after what the stretches before made of it.
PATINA_FN vec4 nodeRampGradient(float x, float low, float high, vec4 a, vec4 b, int interpolation,
                                vec4 before, float number, float count) {
    if (number >= count || x <= low) return before;
    return a + (b - a) * patternRampBlend(x, low, high, interpolation);
}

PATINA_FN vec4 nodeRampLeftRight(vec4 left, vec4 right, vec2 uv) {
    return left + (right - left) * clamp(uv.x, 0.0f, 1.0f);
}
PATINA_FN vec4 nodeRampTopBottom(vec4 top, vec4 bottom, vec2 uv) {
    return bottom + (top - bottom) * clamp(uv.y, 0.0f, 1.0f);
}
PATINA_FN vec4 nodeRamp4(vec4 tl, vec4 tr, vec4 bl, vec4 br, vec2 uv) {
    return vec4(patternRamp4(tl.x, tr.x, bl.x, br.x, uv), patternRamp4(tl.y, tr.y, bl.y, br.y, uv),
                patternRamp4(tl.z, tr.z, bl.z, br.z, uv), patternRamp4(tl.w, tr.w, bl.w, br.w, uv));
}
PATINA_FN vec4 nodeSplitLeftRight(vec4 left, vec4 right, float center, vec2 uv) {
    return uv.x >= center ? right : left;
}
PATINA_FN vec4 nodeSplitTopBottom(vec4 top, vec4 bottom, float center, vec2 uv) {
    return uv.y >= center ? top : bottom;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

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

#endif

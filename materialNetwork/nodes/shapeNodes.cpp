// SPDX-License-Identifier: Apache-2.0
// Shapes, tilings, ramps and splits of the plane.
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using glm::vec2;
using glm::vec4;
using Call = const PatternCall&;

/// Inputs (texcoord, center, radius).
template <int Shape> void shape(Call c) {
    c.out() = vec4(sh::patternShape(Shape, vec2(c.in(0)) - vec2(c.in(1)), c.x(2)));
}

constexpr Pattern line =
    pattern("vec4(patternLine($0.xy - $1.xy, $3.xy, $4.xy, $2.x))", [](Call c) {
        c.out() = vec4(
            sh::patternLine(vec2(c.in(0)) - vec2(c.in(1)), vec2(c.in(3)), vec2(c.in(4)), c.x(2)));
    });

/// Inputs (texcoord, uvtiling, uvoffset, size or thickness, staggered).
vec2 tile(Call c) {
    return sh::patternTile(vec2(c.in(0)), vec2(c.in(1)), vec2(c.in(2)));
}
constexpr Pattern grid =
    pattern("vec4(patternGrid(patternTile($0.xy, $1.xy, $2.xy), $3.x, $4.x != 0.0))",
            [](Call c) { c.out() = vec4(sh::patternGrid(tile(c), c.x(3), c.x(4) != 0.0f)); });
constexpr Pattern crosshatch =
    pattern("vec4(patternCrosshatch(patternTile($0.xy, $1.xy, $2.xy), $3.x, $4.x != 0.0))",
            [](Call c) { c.out() = vec4(sh::patternCrosshatch(tile(c), c.x(3), c.x(4) != 0.0f)); });
/// Cloverleaves are staggered in squares, the others as densely as circles are packed.
template <int Shape> void tiled(Call c) {
    const float row = Shape == 1 ? 0.5f : 0.866025f;
    c.out() = vec4(sh::patternTiledShape(Shape, tile(c), c.x(3), c.x(4) != 0.0f, row));
}
constexpr Pattern checkerboard =
    pattern("$1 + ($0 - $1) * patternChecker(patternTile($4.xy, $2.xy, $3.xy))", [](Call c) {
        const float t =
            sh::patternChecker(sh::patternTile(vec2(c.in(4)), vec2(c.in(2)), vec2(c.in(3))));
        c.out() = c.in(1) + (c.in(0) - c.in(1)) * t;
    });

/// Inputs (texcoord, type, interpolation, num_intervals, interval1, color1, interval2, ...).
constexpr Pattern ramp = rarePattern(
    "nodeRamp($0.xy, nodeWhole($1.x), nodeWhole($2.x), nodeWhole($3.x), float[10]($4.x, "
    "$6.x, $8.x, ${10}.x, ${12}.x, ${14}.x, ${16}.x, ${18}.x, ${20}.x, ${22}.x), "
    "vec4[10]($5, $7, $9, ${11}, ${13}, ${15}, ${17}, ${19}, ${21}, ${23}))",
    [](Call c) {
        const float x = sh::patternRampPosition(vec2(c.in(0)), c.whole(1));
        const int interpolation = c.whole(2);
        const int stretches = std::clamp(c.whole(3) - 1, 0, 9);
        vec4 color = c.in(5);
        for (int i = 1; i <= stretches; ++i) {
            const float low = c.x(2 + 2 * i), high = c.x(4 + 2 * i);
            if (x <= low) continue;
            const float t = sh::patternRampBlend(x, low, high, interpolation);
            color = c.in(3 + 2 * i) + (c.in(5 + 2 * i) - c.in(3 + 2 * i)) * t;
        }
        c.out() = color;
    });

/// Inputs (x, interval1, interval2, color1, color2, interpolation, prev_color, interval_num,
/// num_intervals): one stretch of a ramp, after what the stretches before made of it.
constexpr Pattern rampGradient = rarePattern(
    "nodeRampGradient($0.x, $1.x, $2.x, $3, $4, nodeWhole($5.x), $6, $7.x, $8.x)", [](Call c) {
        const bool beyond = c.x(7) >= c.x(8) || c.x(0) <= c.x(1);
        const float t = sh::patternRampBlend(c.x(0), c.x(1), c.x(2), c.whole(5));
        c.out() = beyond ? c.in(6) : c.in(3) + (c.in(4) - c.in(3)) * t;
    });

float inUnit(float x) {
    return glm::clamp(x, 0.0f, 1.0f);
}
constexpr Pattern rampLeftRight = pattern("$0 + ($1 - $0) * clamp($2.x, 0.0, 1.0)", [](Call c) {
    c.out() = c.in(0) + (c.in(1) - c.in(0)) * inUnit(c.in(2).x);
});

constexpr Pattern rampTopBottom = pattern("$1 + ($0 - $1) * clamp($2.y, 0.0, 1.0)", [](Call c) {
    c.out() = c.in(1) + (c.in(0) - c.in(1)) * inUnit(c.in(2).y);
});

constexpr Pattern ramp4 = pattern("nodeRamp4($0, $1, $2, $3, $4.xy)", [](Call c) {
    for (int i = 0; i < 4; ++i)
        c.out()[i] =
            sh::patternRamp4(c.in(0)[i], c.in(1)[i], c.in(2)[i], c.in(3)[i], vec2(c.in(4)));
});

constexpr Pattern splitLeftRight = pattern(
    "$3.x >= $2.x ? $1 : $0", [](Call c) { c.out() = c.in(3).x >= c.x(2) ? c.in(1) : c.in(0); });
constexpr Pattern splitTopBottom = pattern(
    "$3.y >= $2.x ? $0 : $1", [](Call c) { c.out() = c.in(3).y >= c.x(2) ? c.in(0) : c.in(1); });

constexpr Pattern circle = pattern("vec4(patternShape(0, $0.xy - $1.xy, $2.x))", shape<0>);
constexpr Pattern cloverleaf = pattern("vec4(patternShape(1, $0.xy - $1.xy, $2.x))", shape<1>);
constexpr Pattern hexagon = pattern("vec4(patternShape(2, $0.xy - $1.xy, $2.x))", shape<2>);
constexpr Pattern tiledCircles =
    pattern("nodeTiledShape(0, 0.866025, $0, $1, $2, $3, $4)", tiled<0>);
constexpr Pattern tiledCloverleafs =
    pattern("nodeTiledShape(1, 0.5, $0, $1, $2, $3, $4)", tiled<1>);
constexpr Pattern tiledHexagons =
    pattern("nodeTiledShape(2, 0.866025, $0, $1, $2, $3, $4)", tiled<2>);

#define PATINA_SHAPE "vector2 texcoord=@UV0, vector2 center=0, float radius=0.5"
#define PATINA_TILES(amount)                                                                       \
    "vector2 texcoord=@UV0, vector2 uvtiling=1, vector2 uvoffset=0, float " amount                 \
    ", boolean staggered=0"
#define PATINA_STOP(n) ", float interval" n "=1, color4 color" n "=1"

const NodeRow rows[] = {
    {"ND_circle_float", "circle", PATINA_SHAPE, "float", circle},
    {"ND_cloverleaf_float", "cloverleaf", PATINA_SHAPE, "float", cloverleaf},
    {"ND_hexagon_float", "hexagon", PATINA_SHAPE, "float", hexagon},
    {"ND_line_float", "line",
     "vector2 texcoord=@UV0, vector2 center=0, float radius=0.1, vector2 point1=0.25, "
     "vector2 point2=0.75",
     "float", line},
    {"ND_grid_color3", "grid", PATINA_TILES("thickness=0.05"), "color3", grid},
    {"ND_crosshatch_color3", "crosshatch", PATINA_TILES("thickness=0.05"), "color3", crosshatch},
    {"ND_tiledcircles_color3", "tiledcircles", PATINA_TILES("size=0.5"), "color3", tiledCircles},
    {"ND_tiledcloverleafs_color3", "tiledcloverleafs", PATINA_TILES("size=0.5"), "color3",
     tiledCloverleafs},
    {"ND_tiledhexagons_color3", "tiledhexagons", PATINA_TILES("size=0.5"), "color3", tiledHexagons},
    {"ND_checkerboard_color3", "checkerboard",
     "color3 color1=1, color3 color2=0, vector2 uvtiling=8, vector2 uvoffset=0, "
     "vector2 texcoord=@UV0",
     "color3", checkerboard},
    {"ND_ramp", "ramp",
     "vector2 texcoord=@UV0, integer type=0, integer interpolation=1, integer num_intervals=2, "
     "float interval1=0, color4 color1=0 0 0 1" PATINA_STOP("2") PATINA_STOP("3") PATINA_STOP("4")
         PATINA_STOP("5") PATINA_STOP("6") PATINA_STOP("7") PATINA_STOP("8") PATINA_STOP("9")
             PATINA_STOP("10"),
     "color4", ramp},
    {"ND_ramp_gradient", "ramp_gradient",
     "float x=0, float interval1=0, float interval2=1, color4 color1=0 0 0 1, color4 color2=1, "
     "integer interpolation=1, color4 prev_color=0 0 0 1, integer interval_num=1, "
     "integer num_intervals=2",
     "color4", rampGradient},
    {"ND_ramplr_$", "ramplr", "$ valuel=0, $ valuer=0, vector2 texcoord=@UV0", "$", rampLeftRight,
     Algebra::None, allTypes},
    {"ND_ramptb_$", "ramptb", "$ valuet=0, $ valueb=0, vector2 texcoord=@UV0", "$", rampTopBottom,
     Algebra::None, allTypes},
    {"ND_ramp4_$", "ramp4",
     "$ valuetl=0, $ valuetr=0, $ valuebl=0, $ valuebr=0, vector2 texcoord=@UV0", "$", ramp4,
     Algebra::None, allTypes},
    {"ND_splitlr_$", "splitlr", "$ valuel=0, $ valuer=0, float center=0.5, vector2 texcoord=@UV0",
     "$", splitLeftRight, Algebra::None, allTypes},
    {"ND_splittb_$", "splittb", "$ valuet=0, $ valueb=0, float center=0.5, vector2 texcoord=@UV0",
     "$", splitTopBottom, Algebra::None, allTypes},
};

} // namespace

NodeRows shapeNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

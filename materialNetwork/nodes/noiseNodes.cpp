// SPDX-License-Identifier: Apache-2.0
// Noise and random numbers.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/noise.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

const char* const pairAndTriples = "vector2 vector3 color3";
const char* const triples = "vector3 color3";
const char* const quads = "vector4 color4";
#define PATINA_NOISE2 "float pivot=0, vector2 texcoord=@UV0"
#define PATINA_NOISE3 "float pivot=0, vector3 position=@Pobject"
#define PATINA_OCTAVES "integer octaves=3, float lacunarity=2, float diminish=0.5, "
#define PATINA_OCTAVES2 PATINA_OCTAVES "vector2 texcoord=@UV0"
#define PATINA_OCTAVES3 PATINA_OCTAVES "vector3 position=@Pobject"
#define PATINA_UNIFIED                                                                             \
    "float jitter=1, float outmin=0, float outmax=1, boolean clampoutput=1, "                      \
    "integer octaves=3, float lacunarity=2, float diminish=0.5, integer type=0, integer style=0"
#define PATINA_FLAKE "vector3 normal=@Nworld, vector3 tangent=@Tworld, vector3 bitangent=@Bworld"
#define PATINA_FLAKE_OUT "integer id, float rand, float presence, vector3 flakenormal"
#define PATINA_HSV                                                                                 \
    "float huelow=0, float huehigh=1, float saturationlow=0.825, float saturationhigh=1, "         \
    "float brightnesslow=1, float brightnesshigh=1, integer seed=0"

constexpr Algebra none = Algebra::None;

const NodeRow rows[] = {
    {"ND_noise2d_float", "noise2d", "float amplitude=1, " PATINA_NOISE2, "float",
     PATINA_PATTERN(nodeNoise2Scalar)},
    {"ND_noise2d_$", "noise2d", "$ amplitude=1, " PATINA_NOISE2, "$",
     PATINA_PATTERN(nodeNoise2Triple), none, "vector2 vector3"},
    {"ND_noise2d_color3", "noise2d", "vector3 amplitude=1, " PATINA_NOISE2, "color3",
     PATINA_PATTERN(nodeNoise2Triple)},
    {"ND_noise2d_$FA", "noise2d", "float amplitude=1, " PATINA_NOISE2, "$",
     PATINA_PATTERN(nodeNoise2Triple), none, pairAndTriples},
    {"ND_noise2d_$", "noise2d", "vector4 amplitude=1, " PATINA_NOISE2, "$",
     PATINA_PATTERN(nodeNoise2Quad), none, quads},
    {"ND_noise2d_$FA", "noise2d", "float amplitude=1, " PATINA_NOISE2, "$",
     PATINA_PATTERN(nodeNoise2Quad), none, quads},
    {"ND_noise3d_float", "noise3d", "float amplitude=1, " PATINA_NOISE3, "float",
     PATINA_PATTERN(nodeNoise3Scalar)},
    {"ND_noise3d_$", "noise3d", "$ amplitude=1, " PATINA_NOISE3, "$",
     PATINA_PATTERN(nodeNoise3Triple), none, "vector2 vector3"},
    {"ND_noise3d_color3", "noise3d", "vector3 amplitude=1, " PATINA_NOISE3, "color3",
     PATINA_PATTERN(nodeNoise3Triple)},
    {"ND_noise3d_$FA", "noise3d", "float amplitude=1, " PATINA_NOISE3, "$",
     PATINA_PATTERN(nodeNoise3Triple), none, pairAndTriples},
    {"ND_noise3d_$", "noise3d", "vector4 amplitude=1, " PATINA_NOISE3, "$",
     PATINA_PATTERN(nodeNoise3Quad), none, quads},
    {"ND_noise3d_$FA", "noise3d", "float amplitude=1, " PATINA_NOISE3, "$",
     PATINA_PATTERN(nodeNoise3Quad), none, quads},
    {"ND_fractal2d_float", "fractal2d", "float amplitude=1, " PATINA_OCTAVES2, "float",
     PATINA_PATTERN(nodeFractal2Scalar)},
    {"ND_fractal2d_vector2", "fractal2d", "vector2 amplitude=1, " PATINA_OCTAVES2, "vector2",
     PATINA_PATTERN(nodeFractal2Pair)},
    {"ND_fractal2d_vector2FA", "fractal2d", "float amplitude=1, " PATINA_OCTAVES2, "vector2",
     PATINA_PATTERN(nodeFractal2Pair)},
    {"ND_fractal2d_$", "fractal2d", "vector3 amplitude=1, " PATINA_OCTAVES2, "$",
     PATINA_PATTERN(nodeFractal2Triple), none, triples},
    {"ND_fractal2d_$FA", "fractal2d", "float amplitude=1, " PATINA_OCTAVES2, "$",
     PATINA_PATTERN(nodeFractal2Triple), none, triples},
    {"ND_fractal2d_$", "fractal2d", "vector4 amplitude=1, " PATINA_OCTAVES2, "$",
     PATINA_PATTERN(nodeFractal2Quad), none, quads},
    {"ND_fractal2d_$FA", "fractal2d", "float amplitude=1, " PATINA_OCTAVES2, "$",
     PATINA_PATTERN(nodeFractal2Quad), none, quads},
    {"ND_fractal3d_float", "fractal3d", "float amplitude=1, " PATINA_OCTAVES3, "float",
     PATINA_PATTERN(nodeFractal3Scalar)},
    {"ND_fractal3d_vector2", "fractal3d", "vector2 amplitude=1, " PATINA_OCTAVES3, "vector2",
     PATINA_PATTERN(nodeFractal3Pair)},
    {"ND_fractal3d_vector2FA", "fractal3d", "float amplitude=1, " PATINA_OCTAVES3, "vector2",
     PATINA_PATTERN(nodeFractal3Pair)},
    {"ND_fractal3d_$", "fractal3d", "vector3 amplitude=1, " PATINA_OCTAVES3, "$",
     PATINA_PATTERN(nodeFractal3Triple), none, triples},
    {"ND_fractal3d_$FA", "fractal3d", "float amplitude=1, " PATINA_OCTAVES3, "$",
     PATINA_PATTERN(nodeFractal3Triple), none, triples},
    {"ND_fractal3d_$", "fractal3d", "vector4 amplitude=1, " PATINA_OCTAVES3, "$",
     PATINA_PATTERN(nodeFractal3Quad), none, quads},
    {"ND_fractal3d_$FA", "fractal3d", "float amplitude=1, " PATINA_OCTAVES3, "$",
     PATINA_PATTERN(nodeFractal3Quad), none, quads},
    {"ND_cellnoise2d_float", "cellnoise2d", "vector2 texcoord=@UV0", "float",
     PATINA_PATTERN(noiseCell2)},
    {"ND_cellnoise3d_float", "cellnoise3d", "vector3 position=@Pobject", "float",
     PATINA_PATTERN(noiseCell3)},
    {"ND_worleynoise2d_float", "worleynoise2d",
     "vector2 texcoord=@UV0, float jitter=1, integer style=0", "float",
     PATINA_PATTERN(worleyScalar2)},
    {"ND_worleynoise2d_$", "worleynoise2d",
     "vector2 texcoord=@UV0, float jitter=1, integer style=0", "$", PATINA_PATTERN(worleyNoise2),
     none, "vector2 vector3"},
    {"ND_worleynoise3d_float", "worleynoise3d",
     "vector3 position=@Pobject, float jitter=1, integer style=0", "float",
     PATINA_PATTERN(worleyScalar3)},
    {"ND_worleynoise3d_$", "worleynoise3d",
     "vector3 position=@Pobject, float jitter=1, integer style=0", "$",
     PATINA_PATTERN(worleyNoise3), none, "vector2 vector3"},
    {"ND_unifiednoise2d_float", "unifiednoise2d",
     "vector2 texcoord=@UV0, vector2 freq=1, vector2 offset=0, " PATINA_UNIFIED, "float",
     PATINA_PATTERN(nodeUnified2)},
    {"ND_unifiednoise3d_float", "unifiednoise3d",
     "vector3 position=@Pobject, vector3 freq=1, vector3 offset=0, " PATINA_UNIFIED, "float",
     PATINA_PATTERN(nodeUnified3)},
    {"ND_flake2d", "flake2d",
     "float size=0.01, float roughness=0.1, float coverage=0.5, vector2 "
     "texcoord=@UV0, " PATINA_FLAKE,
     PATINA_FLAKE_OUT, PATINA_PATTERN(nodeFlake2)},
    {"ND_flake3d", "flake3d",
     "float size=0.01, float roughness=0.1, float coverage=0.5, vector3 "
     "position=@Pobject, " PATINA_FLAKE,
     PATINA_FLAKE_OUT, PATINA_PATTERN(nodeFlake3)},
    {"ND_randomfloat_float", "randomfloat", "float in=0, float min=0, float max=1, integer seed=0",
     "float", PATINA_PATTERN(nodeRandomOfFloat)},
    {"ND_randomfloat_integer", "randomfloat",
     "integer in=0, float min=0, float max=1, integer seed=0", "float",
     PATINA_PATTERN(nodeRandomOfInteger)},
    {"ND_randomcolor_float", "randomcolor", "float in=0, " PATINA_HSV, "color3",
     PATINA_PATTERN(nodeRandomColor)},
    {"ND_randomcolor_integer", "randomcolor", "integer in=0, " PATINA_HSV, "color3",
     PATINA_PATTERN(nodeRandomColor)},
};

} // namespace

NodeRows noiseNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
// Noise and random numbers.
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

/// Further channels are the same noise elsewhere.
const vec2 second2(19.0f, 193.0f);
const vec3 second3(19.0f, 193.0f, 17.0f);

/// Inputs (amplitude, pivot, texcoord) and (amplitude, pivot, position).
constexpr Pattern noise2Scalar = pattern("vec4(noisePerlin2($2.xy, 0) * $0.x + $1.x)", [](Call c) {
    c.out() = vec4(sh::noisePerlin2(vec2(c.in(2)), 0) * c.x(0) + c.x(1));
});

vec4 triple2(const vec2& p) {
    return {sh::noisePerlin2(p, 0), sh::noisePerlin2(p, 8), sh::noisePerlin2(p, 16), 0.0f};
}
constexpr Pattern noise2Triple = pattern("nodeNoise2($2.xy) * $0 + $1.x", [](Call c) {
    c.out() = triple2(vec2(c.in(2))) * c.in(0) + c.x(1);
});

constexpr Pattern noise2Quad = rarePattern("nodeNoise2Quad($2.xy) * $0 + $1.x", [](Call c) {
    vec4 v = triple2(vec2(c.in(2)));
    v.w = sh::noisePerlin2(vec2(c.in(2)) + vec2(19.0f, 73.0f), 0);
    c.out() = v * c.in(0) + c.x(1);
});

constexpr Pattern noise3Scalar = pattern("vec4(noisePerlin3($2.xyz, 0) * $0.x + $1.x)", [](Call c) {
    c.out() = vec4(sh::noisePerlin3(vec3(c.in(2)), 0) * c.x(0) + c.x(1));
});

vec4 triple3(const vec3& p) {
    return {sh::noisePerlin3(p, 0), sh::noisePerlin3(p, 8), sh::noisePerlin3(p, 16), 0.0f};
}
constexpr Pattern noise3Triple = pattern("nodeNoise3($2.xyz) * $0 + $1.x", [](Call c) {
    c.out() = triple3(vec3(c.in(2))) * c.in(0) + c.x(1);
});

constexpr Pattern noise3Quad = rarePattern("nodeNoise3Quad($2.xyz) * $0 + $1.x", [](Call c) {
    vec4 v = triple3(vec3(c.in(2)));
    v.w = sh::noisePerlin3(vec3(c.in(2)) + vec3(19.0f, 73.0f, 29.0f), 0);
    c.out() = v * c.in(0) + c.x(1);
});

/// Inputs (amplitude, octaves, lacunarity, diminish, texcoord or position).
float octaves2(Call c, const vec2& offset, int shift) {
    return sh::noiseFractal2(vec2(c.in(4)) + offset, c.whole(1), c.x(2), c.x(3), shift);
}
float octaves3(Call c, const vec3& offset, int shift) {
    return sh::noiseFractal3(vec3(c.in(4)) + offset, c.whole(1), c.x(2), c.x(3), shift);
}
constexpr Pattern fractal2Scalar =
    pattern("vec4(noiseFractal2($4.xy, int($1.x), $2.x, $3.x, 0) * $0.x)",
            [](Call c) { c.out() = vec4(octaves2(c, vec2(0.0f), 0) * c.x(0)); });
constexpr Pattern fractal2Pair =
    rarePattern("nodeFractal2Pair($4.xy, nodeWhole($1.x), $2.x, $3.x) * $0", [](Call c) {
        c.out() = vec4(octaves2(c, vec2(0.0f), 0), octaves2(c, second2, 0), 0.0f, 0.0f) * c.in(0);
    });

constexpr Pattern fractal2Triple =
    pattern("nodeFractal2($4.xy, int($1.x), $2.x, $3.x) * $0", [](Call c) {
        const vec2 o(0.0f);
        c.out() = vec4(octaves2(c, o, 0), octaves2(c, o, 8), octaves2(c, o, 16), 0.0f) * c.in(0);
    });

constexpr char fractal2QuadGlsl[] = "nodeFractal2Quad($4.xy, nodeWhole($1.x), $2.x, $3.x) * $0";
constexpr Pattern fractal2Quad = rarePattern(fractal2QuadGlsl, [](Call c) {
    const vec2 o(0.0f);
    c.out() =
        vec4(octaves2(c, o, 0), octaves2(c, o, 8), octaves2(c, o, 16), octaves2(c, second2, 0)) *
        c.in(0);
});

constexpr Pattern fractal3Scalar =
    pattern("vec4(noiseFractal3($4.xyz, int($1.x), $2.x, $3.x, 0) * $0.x)",
            [](Call c) { c.out() = vec4(octaves3(c, vec3(0.0f), 0) * c.x(0)); });
constexpr Pattern fractal3Pair =
    rarePattern("nodeFractal3Pair($4.xyz, nodeWhole($1.x), $2.x, $3.x) * $0", [](Call c) {
        c.out() = vec4(octaves3(c, vec3(0.0f), 0), octaves3(c, second3, 0), 0.0f, 0.0f) * c.in(0);
    });

constexpr Pattern fractal3Triple =
    pattern("nodeFractal3($4.xyz, int($1.x), $2.x, $3.x) * $0", [](Call c) {
        const vec3 o(0.0f);
        c.out() = vec4(octaves3(c, o, 0), octaves3(c, o, 8), octaves3(c, o, 16), 0.0f) * c.in(0);
    });

constexpr char fractal3QuadGlsl[] = "nodeFractal3Quad($4.xyz, nodeWhole($1.x), $2.x, $3.x) * $0";
constexpr Pattern fractal3Quad = rarePattern(fractal3QuadGlsl, [](Call c) {
    const vec3 o(0.0f);
    c.out() =
        vec4(octaves3(c, o, 0), octaves3(c, o, 8), octaves3(c, o, 16), octaves3(c, second3, 0)) *
        c.in(0);
});

constexpr Pattern cell2 = pattern("vec4(noiseCell2($0.xy))",
                                  [](Call c) { c.out() = vec4(sh::noiseCell2(vec2(c.in(0)))); });
constexpr Pattern cell3 = pattern("vec4(noiseCell3($0.xyz))",
                                  [](Call c) { c.out() = vec4(sh::noiseCell3(vec3(c.in(0)))); });

/// Inputs (texcoord or position, jitter, style).
constexpr Pattern worley2Scalar =
    pattern("vec4(worleyScalar2($0.xy, $1.x, int($2.x)))",
            [](Call c) { c.out() = vec4(sh::worleyScalar2(vec2(c.in(0)), c.x(1), c.whole(2))); });
constexpr Pattern worley2Tuple =
    pattern("vec4(worleyNoise2($0.xy, $1.x, int($2.x)), 0.0)", [](Call c) {
        c.out() = vec4(sh::worleyNoise2(vec2(c.in(0)), c.x(1), c.whole(2)), 0.0f);
    });

constexpr Pattern worley3Scalar =
    pattern("vec4(worleyScalar3($0.xyz, $1.x, int($2.x)))",
            [](Call c) { c.out() = vec4(sh::worleyScalar3(vec3(c.in(0)), c.x(1), c.whole(2))); });
constexpr Pattern worley3Tuple =
    pattern("vec4(worleyNoise3($0.xyz, $1.x, int($2.x)), 0.0)", [](Call c) {
        c.out() = vec4(sh::worleyNoise3(vec3(c.in(0)), c.x(1), c.whole(2)), 0.0f);
    });

/// The unified nodes: (at, freq, offset, jitter, outmin, outmax, clampoutput, octaves, lacunarity,
/// diminish, type, style). A jitter other than 1 turns the lattice of all but Worley noise.
void toRange(Call c, float x) {
    const float low = c.x(4), high = c.x(5);
    const float v = low + x * (high - low);
    c.out() = vec4(c.x(6) != 0.0f ? glm::min(glm::max(v, low), high) : v);
}
constexpr Pattern unified2 = rarePattern(
    "nodeToRange(nodeUnified2($0.xy * $1.xy + $2.xy, $3.x, nodeWhole($7.x), $8.x, $9.x, "
    "nodeWhole(${10}.x), nodeWhole(${11}.x)), $4.x, $5.x, $6.x)",
    [](Call c) {
        const vec2 p = vec2(c.in(0)) * vec2(c.in(1)) + vec2(c.in(2));
        const float angle = (c.x(3) - 1.0f) * 90000.0f;
        const vec2 turned = sh::patternRotate2d(p, angle);
        switch (c.whole(10)) {
        case 0: return toRange(c, 0.5f * sh::noisePerlin2(turned, 0) + 0.5f);
        case 1: return toRange(c, sh::noiseCell2(turned));
        case 2: return toRange(c, sh::worleyScalar2(p, c.x(3), c.whole(11)));
        case 3: return toRange(c, sh::noiseFractal3(vec3(p, angle), c.whole(7), c.x(8), c.x(9), 0));
        default: return toRange(c, 0.0f);
        }
    });

constexpr char unified3Glsl[] =
    "nodeToRange(nodeUnified3($0.xyz * $1.xyz + $2.xyz, $3.x, nodeWhole($7.x), $8.x, "
    "$9.x, nodeWhole(${10}.x), nodeWhole(${11}.x)), $4.x, $5.x, $6.x)";
constexpr Pattern unified3 = rarePattern(unified3Glsl, [](Call c) {
    const vec3 p = vec3(c.in(0)) * vec3(c.in(1)) + vec3(c.in(2));
    const vec3 turned = sh::patternRotate3d(p, (c.x(3) - 1.0f) * 90000.0f, vec3(0.1f, 1.0f, 0.0f));
    switch (c.whole(10)) {
    case 0: return toRange(c, 0.5f * sh::noisePerlin3(turned, 0) + 0.5f);
    case 1: return toRange(c, sh::noiseCell3(turned));
    case 2: return toRange(c, sh::worleyScalar3(p, c.x(3), c.whole(11)));
    case 3: return toRange(c, sh::noiseFractal3(turned, c.whole(7), c.x(8), c.x(9), 0));
    default: return toRange(c, 0.0f);
    }
});

/// Inputs (size, roughness, coverage, at, normal, tangent, bitangent).
void flake(Call c, const vec3& at) {
    const sh::FlakeHit hit =
        sh::patternFlake(c.x(0), c.x(1), c.x(2), at, vec3(c.in(4)), vec3(c.in(5)), vec3(c.in(6)));
    c.out(0) = vec4(float(hit.id));
    c.out(1) = vec4(hit.random);
    c.out(2) = vec4(hit.presence);
    c.out(3) = vec4(hit.normal, 0.0f);
}
constexpr Pattern flake2 =
    rarePattern("nodeFlake($0.x, $1.x, $2.x, vec3($3.xy, 0.0), $4.xyz, $5.xyz, $6.xyz); "
                "vec4(nodeFlakeHit.random); vec4(nodeFlakeHit.presence); vec4(nodeFlakeHit.normal, "
                "0.0)",
                [](Call c) { flake(c, vec3(c.in(3).x, c.in(3).y, 0.0f)); });
constexpr Pattern flake3 =
    rarePattern("nodeFlake($0.x, $1.x, $2.x, $3.xyz, $4.xyz, $5.xyz, $6.xyz); "
                "vec4(nodeFlakeHit.random); vec4(nodeFlakeHit.presence); vec4(nodeFlakeHit.normal, "
                "0.0)",
                [](Call c) { flake(c, vec3(c.in(3))); });

float randomIn(float x, float seed, float low, float high) {
    const float v = low + sh::noiseCell2(vec2(x, seed)) * (high - low);
    return glm::min(glm::max(v, low), high);
}
/// A float is a finer key than an integer.
template <int Scale> void randomFloat(Call c) {
    c.out() = vec4(randomIn(c.x(0) * float(Scale), c.x(3), c.x(1), c.x(2)));
}
constexpr char randomColorGlsl[] =
    "nodeRandomColor($0.x, vec2($1.x, $2.x), vec2($3.x, $4.x), vec2($5.x, $6.x), $7.x)";
constexpr Pattern randomColor = rarePattern(randomColorGlsl, [](Call c) {
    const float seed = c.x(7);
    const auto channel = [&](float salt, int low) {
        const float u = randomIn(c.x(0) * 4096.0f, std::ceil(seed + salt), 0.0f, 1.0f);
        return c.x(low) + u * (c.x(low + 1) - c.x(low));
    };
    const vec3 hsv(channel(413.3f, 1), channel(1522.4f, 3), channel(1813.8f, 5));
    c.out() = vec4(sh::patternHsvToRgb(hsv), 0.0f);
});

constexpr Pattern randomOfFloat =
    rarePattern("vec4(nodeRandom($0.x * 4096.0, $3.x, $1.x, $2.x))", randomFloat<4096>);
constexpr Pattern randomOfInteger =
    rarePattern("vec4(nodeRandom($0.x, $3.x, $1.x, $2.x))", randomFloat<1>);

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
    {"ND_noise2d_float", "noise2d", "float amplitude=1, " PATINA_NOISE2, "float", noise2Scalar},
    {"ND_noise2d_$", "noise2d", "$ amplitude=1, " PATINA_NOISE2, "$", noise2Triple, none,
     "vector2 vector3"},
    {"ND_noise2d_color3", "noise2d", "vector3 amplitude=1, " PATINA_NOISE2, "color3", noise2Triple},
    {"ND_noise2d_$FA", "noise2d", "float amplitude=1, " PATINA_NOISE2, "$", noise2Triple, none,
     pairAndTriples},
    {"ND_noise2d_$", "noise2d", "vector4 amplitude=1, " PATINA_NOISE2, "$", noise2Quad, none,
     quads},
    {"ND_noise2d_$FA", "noise2d", "float amplitude=1, " PATINA_NOISE2, "$", noise2Quad, none,
     quads},
    {"ND_noise3d_float", "noise3d", "float amplitude=1, " PATINA_NOISE3, "float", noise3Scalar},
    {"ND_noise3d_$", "noise3d", "$ amplitude=1, " PATINA_NOISE3, "$", noise3Triple, none,
     "vector2 vector3"},
    {"ND_noise3d_color3", "noise3d", "vector3 amplitude=1, " PATINA_NOISE3, "color3", noise3Triple},
    {"ND_noise3d_$FA", "noise3d", "float amplitude=1, " PATINA_NOISE3, "$", noise3Triple, none,
     pairAndTriples},
    {"ND_noise3d_$", "noise3d", "vector4 amplitude=1, " PATINA_NOISE3, "$", noise3Quad, none,
     quads},
    {"ND_noise3d_$FA", "noise3d", "float amplitude=1, " PATINA_NOISE3, "$", noise3Quad, none,
     quads},
    {"ND_fractal2d_float", "fractal2d", "float amplitude=1, " PATINA_OCTAVES2, "float",
     fractal2Scalar},
    {"ND_fractal2d_vector2", "fractal2d", "vector2 amplitude=1, " PATINA_OCTAVES2, "vector2",
     fractal2Pair},
    {"ND_fractal2d_vector2FA", "fractal2d", "float amplitude=1, " PATINA_OCTAVES2, "vector2",
     fractal2Pair},
    {"ND_fractal2d_$", "fractal2d", "vector3 amplitude=1, " PATINA_OCTAVES2, "$", fractal2Triple,
     none, triples},
    {"ND_fractal2d_$FA", "fractal2d", "float amplitude=1, " PATINA_OCTAVES2, "$", fractal2Triple,
     none, triples},
    {"ND_fractal2d_$", "fractal2d", "vector4 amplitude=1, " PATINA_OCTAVES2, "$", fractal2Quad,
     none, quads},
    {"ND_fractal2d_$FA", "fractal2d", "float amplitude=1, " PATINA_OCTAVES2, "$", fractal2Quad,
     none, quads},
    {"ND_fractal3d_float", "fractal3d", "float amplitude=1, " PATINA_OCTAVES3, "float",
     fractal3Scalar},
    {"ND_fractal3d_vector2", "fractal3d", "vector2 amplitude=1, " PATINA_OCTAVES3, "vector2",
     fractal3Pair},
    {"ND_fractal3d_vector2FA", "fractal3d", "float amplitude=1, " PATINA_OCTAVES3, "vector2",
     fractal3Pair},
    {"ND_fractal3d_$", "fractal3d", "vector3 amplitude=1, " PATINA_OCTAVES3, "$", fractal3Triple,
     none, triples},
    {"ND_fractal3d_$FA", "fractal3d", "float amplitude=1, " PATINA_OCTAVES3, "$", fractal3Triple,
     none, triples},
    {"ND_fractal3d_$", "fractal3d", "vector4 amplitude=1, " PATINA_OCTAVES3, "$", fractal3Quad,
     none, quads},
    {"ND_fractal3d_$FA", "fractal3d", "float amplitude=1, " PATINA_OCTAVES3, "$", fractal3Quad,
     none, quads},
    {"ND_cellnoise2d_float", "cellnoise2d", "vector2 texcoord=@UV0", "float", cell2},
    {"ND_cellnoise3d_float", "cellnoise3d", "vector3 position=@Pobject", "float", cell3},
    {"ND_worleynoise2d_float", "worleynoise2d",
     "vector2 texcoord=@UV0, float jitter=1, integer style=0", "float", worley2Scalar},
    {"ND_worleynoise2d_$", "worleynoise2d",
     "vector2 texcoord=@UV0, float jitter=1, integer style=0", "$", worley2Tuple, none,
     "vector2 vector3"},
    {"ND_worleynoise3d_float", "worleynoise3d",
     "vector3 position=@Pobject, float jitter=1, integer style=0", "float", worley3Scalar},
    {"ND_worleynoise3d_$", "worleynoise3d",
     "vector3 position=@Pobject, float jitter=1, integer style=0", "$", worley3Tuple, none,
     "vector2 vector3"},
    {"ND_unifiednoise2d_float", "unifiednoise2d",
     "vector2 texcoord=@UV0, vector2 freq=1, vector2 offset=0, " PATINA_UNIFIED, "float", unified2},
    {"ND_unifiednoise3d_float", "unifiednoise3d",
     "vector3 position=@Pobject, vector3 freq=1, vector3 offset=0, " PATINA_UNIFIED, "float",
     unified3},
    {"ND_flake2d", "flake2d",
     "float size=0.01, float roughness=0.1, float coverage=0.5, vector2 "
     "texcoord=@UV0, " PATINA_FLAKE,
     PATINA_FLAKE_OUT, flake2},
    {"ND_flake3d", "flake3d",
     "float size=0.01, float roughness=0.1, float coverage=0.5, vector3 "
     "position=@Pobject, " PATINA_FLAKE,
     PATINA_FLAKE_OUT, flake3},
    {"ND_randomfloat_float", "randomfloat", "float in=0, float min=0, float max=1, integer seed=0",
     "float", randomOfFloat},
    {"ND_randomfloat_integer", "randomfloat",
     "integer in=0, float min=0, float max=1, integer seed=0", "float", randomOfInteger},
    {"ND_randomcolor_float", "randomcolor", "float in=0, " PATINA_HSV, "color3", randomColor},
    {"ND_randomcolor_integer", "randomcolor", "integer in=0, " PATINA_HSV, "color3", randomColor},
};

} // namespace

NodeRows noiseNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
// Noise and random numbers. Further channels are the same noise elsewhere. Loops over channels, so
// that drivers read each kind of noise once.
#ifndef PATINA_NODE_ROWS

PATINA_FN float nodeNoise2Scalar(float amplitude, float pivot, vec2 p) {
    return noisePerlin2(p, 0) * amplitude + pivot;
}
PATINA_FN vec4 noiseTriple2(vec2 p) {
    vec4 v = vec4(0.0f);
    for (int i = 0; i < 3; ++i)
        v[i] = noisePerlin2(p, 8 * i);
    return v;
}
PATINA_FN vec4 nodeNoise2Triple(vec4 amplitude, float pivot, vec2 p) {
    return noiseTriple2(p) * amplitude + pivot;
}
PATINA_FN vec4 nodeNoise2Quad(vec4 amplitude, float pivot, vec2 p) {
    vec4 v = noiseTriple2(p);
    v.w = noisePerlin2(p + vec2(19.0f, 73.0f), 0);
    return v * amplitude + pivot;
}

PATINA_FN float nodeNoise3Scalar(float amplitude, float pivot, vec3 p) {
    return noisePerlin3(p, 0) * amplitude + pivot;
}
PATINA_FN vec4 noiseTriple3(vec3 p) {
    vec4 v = vec4(0.0f);
    for (int i = 0; i < 3; ++i)
        v[i] = noisePerlin3(p, 8 * i);
    return v;
}
PATINA_FN vec4 nodeNoise3Triple(vec4 amplitude, float pivot, vec3 p) {
    return noiseTriple3(p) * amplitude + pivot;
}
PATINA_FN vec4 nodeNoise3Quad(vec4 amplitude, float pivot, vec3 p) {
    vec4 v = noiseTriple3(p);
    v.w = noisePerlin3(p + vec3(19.0f, 73.0f, 29.0f), 0);
    return v * amplitude + pivot;
}

PATINA_FN float nodeFractal2Scalar(float amplitude, int octaves, float lacunarity, float diminish,
                                   vec2 p) {
    return noiseFractal2(p, octaves, lacunarity, diminish, 0) * amplitude;
}
PATINA_FN vec2 nodeFractal2Pair(vec2 amplitude, int octaves, float lacunarity, float diminish,
                                vec2 p) {
    vec2 v = vec2(0.0f);
    for (int i = 0; i < 2; ++i)
        v[i] = noiseFractal2(p + float(i) * vec2(19.0f, 193.0f), octaves, lacunarity, diminish, 0);
    return v * amplitude;
}
PATINA_FN vec3 nodeFractal2Triple(vec3 amplitude, int octaves, float lacunarity, float diminish,
                                  vec2 p) {
    vec3 v = vec3(0.0f);
    for (int i = 0; i < 3; ++i)
        v[i] = noiseFractal2(p, octaves, lacunarity, diminish, 8 * i);
    return v * amplitude;
}
PATINA_FN vec4 nodeFractal2Quad(vec4 amplitude, int octaves, float lacunarity, float diminish,
                                vec2 p) {
    vec4 v = vec4(0.0f);
    for (int i = 0; i < 4; ++i)
        v[i] = noiseFractal2(i < 3 ? p : p + vec2(19.0f, 193.0f), octaves, lacunarity, diminish,
                             i < 3 ? 8 * i : 0);
    return v * amplitude;
}

PATINA_FN float nodeFractal3Scalar(float amplitude, int octaves, float lacunarity, float diminish,
                                   vec3 p) {
    return noiseFractal3(p, octaves, lacunarity, diminish, 0) * amplitude;
}
PATINA_FN vec2 nodeFractal3Pair(vec2 amplitude, int octaves, float lacunarity, float diminish,
                                vec3 p) {
    vec2 v = vec2(0.0f);
    for (int i = 0; i < 2; ++i)
        v[i] = noiseFractal3(p + float(i) * vec3(19.0f, 193.0f, 17.0f), octaves, lacunarity,
                             diminish, 0);
    return v * amplitude;
}
PATINA_FN vec3 nodeFractal3Triple(vec3 amplitude, int octaves, float lacunarity, float diminish,
                                  vec3 p) {
    vec3 v = vec3(0.0f);
    for (int i = 0; i < 3; ++i)
        v[i] = noiseFractal3(p, octaves, lacunarity, diminish, 8 * i);
    return v * amplitude;
}
PATINA_FN vec4 nodeFractal3Quad(vec4 amplitude, int octaves, float lacunarity, float diminish,
                                vec3 p) {
    vec4 v = vec4(0.0f);
    for (int i = 0; i < 4; ++i)
        v[i] = noiseFractal3(i < 3 ? p : p + vec3(19.0f, 193.0f, 17.0f), octaves, lacunarity,
                             diminish, i < 3 ? 8 * i : 0);
    return v * amplitude;
}

PATINA_FN float toRange(float x, float low, float high, bool clamps) {
    float v = low + x * (high - low);
    return clamps ? min(max(v, low), high) : v;
}
// A jitter other than 1 turns the lattice of all but Worley noise.
PATINA_FN float unifiedNoise2(vec2 p, float jitter, int octaves, float lacunarity, float diminish,
                              int type, int style) {
    float angle = (jitter - 1.0f) * 90000.0f;
    if (type == 0) return 0.5f * noisePerlin2(patternRotate2d(p, angle), 0) + 0.5f;
    if (type == 1) return noiseCell2(patternRotate2d(p, angle));
    if (type == 2) return worleyScalar2(p, jitter, style);
    if (type == 3) return noiseFractal3(vec3(p, angle), octaves, lacunarity, diminish, 0);
    return 0.0f;
}
PATINA_FN float nodeUnified2(vec2 uv, vec2 frequency, vec2 offset, float jitter, float low,
                             float high, bool clamps, int octaves, float lacunarity, float diminish,
                             int type, int style) {
    return toRange(
        unifiedNoise2(uv * frequency + offset, jitter, octaves, lacunarity, diminish, type, style),
        low, high, clamps);
}
PATINA_FN float unifiedNoise3(vec3 p, float jitter, int octaves, float lacunarity, float diminish,
                              int type, int style) {
    if (type == 2) return worleyScalar3(p, jitter, style);
    vec3 turned = patternRotate3d(p, (jitter - 1.0f) * 90000.0f, vec3(0.1f, 1.0f, 0.0f));
    if (type == 0) return 0.5f * noisePerlin3(turned, 0) + 0.5f;
    if (type == 1) return noiseCell3(turned);
    if (type == 3) return noiseFractal3(turned, octaves, lacunarity, diminish, 0);
    return 0.0f;
}
PATINA_FN float nodeUnified3(vec3 p, vec3 frequency, vec3 offset, float jitter, float low,
                             float high, bool clamps, int octaves, float lacunarity, float diminish,
                             int type, int style) {
    return toRange(
        unifiedNoise3(p * frequency + offset, jitter, octaves, lacunarity, diminish, type, style),
        low, high, clamps);
}

PATINA_FN int nodeFlake3(float size, float roughness, float coverage, vec3 at, vec3 n, vec3 t,
                         vec3 b, PATINA_OUT(float) random, PATINA_OUT(float) presence,
                         PATINA_OUT(vec3) normal) {
    FlakeHit hit = patternFlake(size, roughness, coverage, at, n, t, b);
    random = hit.random;
    presence = hit.presence;
    normal = hit.normal;
    return hit.id;
}
PATINA_FN int nodeFlake2(float size, float roughness, float coverage, vec2 at, vec3 n, vec3 t,
                         vec3 b, PATINA_OUT(float) random, PATINA_OUT(float) presence,
                         PATINA_OUT(vec3) normal) {
    return nodeFlake3(size, roughness, coverage, vec3(at, 0.0f), n, t, b, random, presence, normal);
}

PATINA_FN float randomIn(float x, float seed, float low, float high) {
    float v = low + noiseCell2(vec2(x, seed)) * (high - low);
    return min(max(v, low), high);
}
// A float is a finer key than an integer.
PATINA_FN float nodeRandomOfFloat(float x, float low, float high, float seed) {
    return randomIn(x * 4096.0f, seed, low, high);
}
PATINA_FN float nodeRandomOfInteger(float x, float low, float high, float seed) {
    return randomIn(x, seed, low, high);
}
PATINA_FN float randomChannel(float x, float salt, float low, float high) {
    float u = randomIn(x * 4096.0f, ceil(salt), 0.0f, 1.0f);
    return low + u * (high - low);
}
PATINA_FN vec3 nodeRandomColor(float x, float hueLow, float hueHigh, float saturationLow,
                               float saturationHigh, float brightnessLow, float brightnessHigh,
                               float seed) {
    return patternHsvToRgb(vec3(randomChannel(x, seed + 413.3f, hueLow, hueHigh),
                                randomChannel(x, seed + 1522.4f, saturationLow, saturationHigh),
                                randomChannel(x, seed + 1813.8f, brightnessLow, brightnessHigh)));
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

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

#endif

// SPDX-License-Identifier: Apache-2.0
// The base of a generated material's text: the shading point, lobes and closures, and nodes.
#define PATINA_ENERGY_KNOWN(known) true // by lobeFix()
#include "shaders/compat/glsl.glsl"
#include "shaders/lobes.glsl"
#include "shaders/closure.glsl"
#include "shaders/patterns.glsl"

const int ENERGY_CURVE_NODES = 64; // EnergyCurve::nodeCount

// World space, unit vectors; see materialNetwork/shadingPoint.h.
struct SurfacePoint {
    vec3 position;
    vec3 objectPosition;
    vec3 geometricNormal;
    vec3 normal;
    vec3 tangent;
    vec3 bitangent;
    vec3 view;
    mat3 objectToWorldNormal;
    float lengthPerUv;
    float uvFootprint;
    uint seed;
};
SurfacePoint point;
vec3 worldOrigin = vec3(0.0); // what positions are relative to

// Defined by the pass: the value of a primvar, or what stands in for it.
vec4 primvar(int slot, vec4 fallback);

struct MaterialSample {
    vec3 wi;
    vec3 weight;   // of delta lobes, or both shares below together
    vec3 diffuseWeight;
    vec3 specularWeight;
    float pdf;
    int event;
    bool diffuse;
    float eta; // n(wo side) / n(wi side) of what transmits, else 1
};

MaterialEval materialEvalBut(vec3 wi, int without);

// Of a direction about an axis, 0 to 1 from the tangent on.
float turnAbout(vec3 wo, vec3 n) {
    vec2 at = azimuthOf(wo, n, point.tangent);
    return dot(at, at) > 0.0 ? fract(atan(at.y, at.x) / TWO_PI) : 0.0;
}

bool woOutside() {
    return dot(point.view, point.geometricNormal) >= 0.0;
}

// normal, tangent: zero for those of the point.
Frame makeFrame(vec3 normal, vec3 tangent, bool flips) {
    return shadingFrame(point.view, point.geometricNormal, point.normal, point.tangent, normal, tangent,
                        flips);
}

// Defined by the text of a material.
vec4 materialParameter(int i);

// Places on the curve of an EnergyCurve: the node before z, and how far z is from it to the next.
int energyCurveNode(float z, out float share) {
    float t = sqrt(sqrt(min(z, 1.0))) * float(ENERGY_CURVE_NODES - 1);
    int i = min(int(t), ENERGY_CURVE_NODES - 2);
    share = t - float(i);
    return i;
}
vec4 alongCurve(int i, int stride, float share) {
    vec4 a = materialParameter(i);
    return a + (materialParameter(i + stride) - a) * share;
}
// curve: of the parameters, where x says whether the curve is there and its nodes follow; -1 none.
bool hasCurve(int curve, vec3 wo) {
    return curve >= 0 && wo.z >= 0.0 && materialParameter(max(curve, 0)).x != 0.0;
}
DielectricEnergy dielectricEnergyBy(DielectricLobe l, vec3 wo, int curve) {
    if (!hasCurve(curve, wo)) return dielectricEnergy(l, wo);
    float share;
    vec4 v = alongCurve(curve + 1 + energyCurveNode(wo.z, share), 1, share);
    return DielectricEnergy(v.x, v.y, v.z, v.w);
}
SchlickEnergy schlickEnergyBy(SchlickLobe l, vec3 wo, int curve) {
    if (!hasCurve(curve, wo)) return schlickEnergy(l, wo);
    float share;
    int i = curve + 1 + 4 * energyCurveNode(wo.z, share);
    return SchlickEnergy(alongCurve(i, 4, share).xyz, alongCurve(i + 1, 4, share).xyz,
                         alongCurve(i + 2, 4, share).xyz, alongCurve(i + 3, 4, share).xyz);
}

// lobeFix() of an interface, whose energy may be read off a curve. fixTransmittance: what it
// refracts.
vec3 fixTransmittance;
vec3 lobeFix(inout DielectricLobe l, vec3 wo, int curve, out vec3 albedo) {
    DielectricEnergy e = dielectricEnergyBy(l, wo, curve);
    fixTransmittance = l.tint * e.t;
    return dielectricWith(l, e, albedo);
}
vec3 lobeFix(inout SchlickLobe l, vec3 wo, int curve, out vec3 albedo) {
    SchlickEnergy e = schlickEnergyBy(l, wo, curve);
    fixTransmittance = l.tint * e.t;
    return schlickWith(l, e, albedo);
}

MaterialSample materialSampleNone() {
    return MaterialSample(vec3(0.0, 0.0, 1.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0, false, 1.0);
}

// The lobe that was drawn counts by its own sample, the others by their values there.
MaterialSample finishSample(MaterialSample s, LobeSample l, int drawn, vec3 weight, float chance) {
    bool reflects = (l.event & LOBE_REFLECT) != 0;
    if (drawn < 0 || l.event == 0 ||
        isReflected(s.wi, point.geometricNormal, woOutside()) != reflects)
        return materialSampleNone();
    s.event = l.event;
    s.eta = l.eta;
    bool delta = (l.event & LOBE_DELTA) != 0;
    MaterialEval e = materialEvalNone();
    if (!delta) e = materialEvalBut(s.wi, drawn);
    vec3 own =
        delta ? drawnAlone(weight, l.weight, chance) : drawnValue(weight, l.weight, l.pdf);
    e.diffuse += s.diffuse ? own : vec3(0.0);
    e.specular += s.diffuse ? vec3(0.0) : own;
    s.pdf = e.pdf + chance * l.pdf;
    if (!(s.pdf > 0.0)) return materialSampleNone();
    float inverse = delta ? 1.0 : 1.0 / s.pdf;
    s.diffuseWeight = e.diffuse * inverse;
    s.specularWeight = e.specular * inverse;
    s.weight = s.diffuseWeight + s.specularWeight;
    return s;
}

// Pattern nodes beyond what shaders/patterns has.
vec4 nodeDivide(vec4 a, vec4 b) {
    return mix(a / b, vec4(0.0), equal(b, vec4(0.0)));
}
vec4 nodeModulo(vec4 a, vec4 b) {
    return mix(a - b * floor(a / b), vec4(0.0), equal(b, vec4(0.0)));
}
float nodePowerOne(float a, float b) {
    // GLSL leaves a negative base open; C++ gives a number for whole exponents.
    float p = pow(abs(a), b);
    if (a < 0.0) p = b == floor(b) ? (mod(b, 2.0) == 0.0 ? p : -p) : 0.0;
    if (b == 0.0) p = 1.0;
    return isinf(p) || isnan(p) ? 0.0 : p;
}
vec4 nodePower(vec4 a, vec4 b) {
    return vec4(nodePowerOne(a.x, b.x), nodePowerOne(a.y, b.y), nodePowerOne(a.z, b.z),
                nodePowerOne(a.w, b.w));
}
vec4 nodeRound(vec4 a) {
    return sign(a) * floor(abs(a) + 0.5);
}
// Drivers' own asin and acos are off by 3e-4.
vec4 nodeAsin(vec4 a) {
    vec4 x = clamp(a, -1.0, 1.0);
    return atan(x, sqrt((1.0 - x) * (1.0 + x)));
}
vec4 nodeAcos(vec4 a) {
    vec4 x = clamp(a, -1.0, 1.0);
    return atan(sqrt((1.0 - x) * (1.0 + x)), x);
}
vec4 nodeSmoothstep(vec4 x, vec4 low, vec4 high) {
    vec4 t = mix(vec4(greaterThanEqual(x, high)), clamp((x - low) / (high - low), 0.0, 1.0),
                 greaterThan(high, low));
    return t * t * (3.0 - 2.0 * t);
}
float nodeDot(vec4 a, vec4 b, int size) {
    vec4 p = a * b;
    return p.x + (size > 1 ? p.y : 0.0) + (size > 2 ? p.z : 0.0) + (size > 3 ? p.w : 0.0);
}
vec4 nodeNormalize(vec4 a, int size) {
    float l = sqrt(nodeDot(a, a, size));
    return l > 0.0 ? a / l : vec4(0.0);
}
float nodeLargest(vec4 a, int size) {
    float x = max(a.x, a.y);
    if (size > 2) x = max(x, a.z);
    return size > 3 ? max(x, a.w) : x;
}
vec4 nodeArtisticIor(vec4 r, vec4 e) {
    return vec4(patternArtisticIor(r.x, e.x), patternArtisticIor(r.y, e.y),
                patternArtisticIor(r.z, e.z), 0.0);
}
vec4 nodeArtisticExtinction(vec4 r, vec4 e) {
    vec4 n = nodeArtisticIor(r, e);
    return vec4(patternArtisticExtinction(r.x, n.x), patternArtisticExtinction(r.y, n.y),
                patternArtisticExtinction(r.z, n.z), 0.0);
}
vec2 nodeTiledUv(vec4 uv, vec4 tiling, vec4 offset, vec4 image, vec4 tile) {
    vec2 t = uv.xy * tiling.xy - offset.xy;
    return vec2(image.x != 0.0 ? t.x / image.x * tile.x : 0.0,
                image.y != 0.0 ? t.y / image.y * tile.y : 0.0);
}
float nodeTiledFootprint(vec4 tiling) {
    return point.uvFootprint * max(abs(tiling.x), abs(tiling.y));
}
// Loops, so that drivers read each kind of noise once.
vec4 nodeNoise2(vec2 p) {
    vec4 v = vec4(0.0);
    for (int i = 0; i < 3; ++i)
        v[i] = noisePerlin2(p, 8 * i);
    return v;
}
vec4 nodeNoise3(vec3 p) {
    vec4 v = vec4(0.0);
    for (int i = 0; i < 3; ++i)
        v[i] = noisePerlin3(p, 8 * i);
    return v;
}
vec4 nodeFractal2(vec2 p, int octaves, float lacunarity, float diminish) {
    vec4 v = vec4(0.0);
    for (int i = 0; i < 3; ++i)
        v[i] = noiseFractal2(p, octaves, lacunarity, diminish, 8 * i);
    return v;
}
vec4 nodeFractal3(vec3 p, int octaves, float lacunarity, float diminish) {
    vec4 v = vec4(0.0);
    for (int i = 0; i < 3; ++i)
        v[i] = noiseFractal3(p, octaves, lacunarity, diminish, 8 * i);
    return v;
}
vec4 nodeTiledShape(int shape, float row, vec4 uv, vec4 tiling, vec4 offset, vec4 size, vec4 staggered) {
    return vec4(patternTiledShape(shape, patternTile(uv.xy, tiling.xy, offset.xy), size.x,
                                  staggered.x != 0.0, row));
}
vec4 nodeRamp4(vec4 tl, vec4 tr, vec4 bl, vec4 br, vec2 uv) {
    vec2 t = clamp(uv, 0.0, 1.0);
    return mix(mix(bl, br, t.x), mix(tl, tr, t.x), t.y);
}
// mode 0 is world space.
vec4 nodePosition(int mode) {
    return vec4(mode == 0 ? point.position + worldOrigin : point.objectPosition, 0.0);
}
vec4 nodeNormal(int mode, vec3 n) {
    if (mode == 0) return vec4(n, 0.0);
    return vec4(unitOr(inverse(point.objectToWorldNormal) * n, vec3(0.0, 0.0, 1.0)), 0.0);
}
vec4 nodeTangent(int mode, vec3 t) {
    if (mode == 0) return vec4(t, 0.0);
    return vec4(unitOr(transpose(point.objectToWorldNormal) * t, vec3(1.0, 0.0, 0.0)), 0.0);
}
// ImageTexture::sample(): lambda from the footprint and the larger side.
vec4 nodeTexture(sampler2D s, vec2 uv, float footprint) {
    ivec2 size = textureSize(s, 0);
    float lambda = log2(max(footprint * float(max(size.x, size.y)), 1e-6));
    return textureLod(s, uv, lambda);
}

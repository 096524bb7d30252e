// SPDX-License-Identifier: Apache-2.0
// The base of a generated material's text: the shading point, lobes and closures, and nodes.
#define PATINA_ENERGY_KNOWN(known) true // by lobeFix()
#include "shaders/compat/glsl.glsl"
#include "shaders/lobes.glsl"
#include "shaders/closure.glsl"
#include "shaders/patterns.glsl"
#include "shaders/compat/nodes.glsl"

const int ENERGY_CURVE_NODES = 64; // EnergyCurve::nodeCount

SurfacePoint point;
float presentShare = 1.0; // that is not absent, whatever passes through it; set by materialPresence()

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
Frame makeFrame(vec3 normal, vec3 tangent, bool flips, bool bends) {
    return shadingFrame(point.view, point.geometricNormal, point.normal, point.tangent, normal, tangent, flips,
                        bends);
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

// ImageTexture::sample(): lambda from the footprint and the larger side.
vec4 nodeTexture(sampler2D s, vec2 uv, float footprint) {
    ivec2 size = textureSize(s, 0);
    float lambda = log2(max(footprint * float(max(size.x, size.y)), 1e-6));
    return textureLod(s, uv, lambda);
}

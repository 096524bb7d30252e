#include "shaders/patterns/nodes/difference.glsl"
#include "shaders/patterns/nodes/geometry.glsl"
#include "shaders/patterns/nodes/noise.glsl"
#include "shaders/patterns/nodes/texture.glsl"
layout(std140, binding = 1) uniform Parameters { vec4 parameters[23]; };
vec4 materialParameter(int i) { return parameters[i]; }
layout(binding = 0) uniform sampler2D sampler0;
vec4 texture0(vec2 uv, float footprint) { return nodeTexture(sampler0, uv, footprint); }
vec4 texel(int map, vec2 uv, float footprint) {
    if (map == 0) return texture0(uv, footprint);
    return vec4(0.0);
}
vec4 r5;
vec4 r6;
vec4 r7;
vec4 r8;
vec4 r9;
vec4 r10;
vec4 r11;
vec4 r12;
vec4 r13;
vec4 r14;
vec4 r15;
vec4 r16;
vec4 r17;
vec4 r18;
vec4 r19;
BurleyLobe lobe0;
vec3 lobeWeight[1];
vec3 lobeAlbedo[1];
float lobeChance[1];
Frame frames[1];
vec3 passThrough;
void instantiate() {
    r5 = nodeTuplePrimvar(primvar(0, parameters[0]));
    r6 = nodeImage(parameters[1], r5.xy, 0, 0, point);
    r7 = vec4(nodeFractal2Scalar(parameters[2].x, patternWhole(parameters[3].x), parameters[4].x, parameters[5].x, r5.xy));
    r8 = vec4(nodeTexcoord(primvar(1, vec4(0.0))), 0.0);
    r9 = nodeShiftTexcoord(r5, parameters[6].x != 0.0, point);
    r10 = vec4(nodeFractal2Scalar(parameters[7].x, patternWhole(parameters[8].x), parameters[9].x, parameters[10].x, r9.xy));
    r11 = nodeShiftTexcoord(r5, parameters[11].x != 0.0, point);
    r12 = vec4(nodeFractal2Scalar(parameters[12].x, patternWhole(parameters[13].x), parameters[14].x, parameters[15].x, r11.xy));
    r13 = nodeShiftTexcoord(r8, parameters[16].x != 0.0, point);
    r14 = nodeShiftTexcoord(r8, parameters[17].x != 0.0, point);
    r15 = vec4(nodeSlope(r7.x, r10.x, r12.x, parameters[18].x, r8.xy, r13.xy, r14.xy, point), 0.0);
    r16 = vec4(nodeNormal(0, point), 0.0);
    r17 = vec4(nodeTangent(0, point), 0.0);
    r18 = vec4(nodeBitangent(0, point), 0.0);
    r19 = vec4(patternNormalMap(r15.xyz, parameters[19].xy, r16.xyz, r17.xyz, r18.xyz), 0.0);
    frames[0] = makeFrame(r19.xyz, vec3(0.0), true, false);
    lobe0 = burleySetup(r6.xyz, parameters[20].x);
    vec3 coverage0 = lobeFix(lobe0, frames[0].wo, lobeAlbedo[0]);
    coverage0 = unitColor(coverage0);
    lobeWeight[0] = closureScaled(vec3(1.0), unit(parameters[21].x));
    passThrough = vec3(0.0);
}
void materialSetup() {
    instantiate();
    float sum = 0.0;
    int present = 0;
    bool has0 = hasWeight(lobeWeight[0]);
    present += has0 ? 1 : 0;
    lobeChance[0] = !has0 ? 0.0 : selectionShare(lobeWeight[0], lobeAlbedo[0], present == 1);
    sum += lobeChance[0];
    lobeChance[0] /= sum > 0.0 ? sum : 1.0;
    if (!(sum > 0.0)) lobeWeight[0] = vec3(0.0);
}
float materialPresence(out vec3 passes) {
    passes = vec3(1.0);
    presentShare = unit(parameters[22].x);
    return presentShare;
}
vec3 materialEmission(vec3 wo) {
    return vec3(0.0);
}
MaterialEval materialEvalBut(vec3 wi, int without) {
    MaterialEval sum = materialEvalNone();
    bool reflects = isReflected(wi, point.geometricNormal, woOutside());
    vec3 wi0 = toLocal(frames[0], wi);
    if (without != 0) addLobe(sum, lobeAgrees(frames[0].wo.z, wi0.z, reflects) && hasWeight(lobeWeight[0]), true, lobeWeight[0], lobeChance[0], burleyEval(lobe0, frames[0].wo, wi0));
    return sum;
}
MaterialEval materialEval(vec3 wi) { return materialEvalBut(wi, -1); }
MaterialSample materialSample(vec3 u, float uLobe) {
    Selection drawn = selectionNone();
    selectLobe(drawn, 0, lobeChance[0], uLobe);
    MaterialSample s = materialSampleNone();
    LobeSample l = lobeSampleNone();
    vec3 weight = vec3(0.0);
    float chance = 0.0;
    if (drawn.lobe == 0) {
        l = burleySample(lobe0, frames[0].wo, u);
        s.wi = toWorld(frames[0], l.wi);
        s.diffuse = true;
        weight = lobeWeight[0];
        chance = lobeChance[0];
    }
    return finishSample(s, l, drawn.lobe, weight, chance);
}

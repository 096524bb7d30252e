#include "shaders/patterns/nodes/geometry.glsl"
#include "shaders/patterns/nodes/noise.glsl"
layout(std140, binding = 1) uniform Parameters { vec4 parameters[77]; };
vec4 materialParameter(int i) { return parameters[i]; }
vec4 texel(int map, vec2 uv, float footprint) {
    return vec4(0.0);
}
vec4 r11;
vec4 r12;
vec4 r13;
vec4 r14;
vec4 r15;
vec4 r16;
vec4 r17;
vec4 r18;
DielectricLobe lobe0;
ConductorLobe lobe1;
vec3 lobeWeight[2];
vec3 lobeAlbedo[2];
float lobeChance[2];
vec3 lobeTransmittance[2];
Frame frames[2];
vec3 passThrough;
void instantiate() {
    r11 = vec4(nodeNormal(0, point), 0.0);
    r12 = vec4(nodeTangent(0, point), 0.0);
    r13 = vec4(nodePosition(1, point), 0.0);
    r14 = vec4(nodeBitangent(0, point), 0.0);
    { float o1; float o2; vec3 o3; r15 = vec4(nodeFlake3(parameters[0].x, parameters[1].x, parameters[2].x, r13.xyz, r11.xyz, r12.xyz, r14.xyz, o1, o2, o3)); r16 = vec4(o1); r17 = vec4(o2); r18 = vec4(o3, 0.0); }
    frames[0] = makeFrame(vec3(0.0), vec3(0.0), false, true);
    frames[1] = makeFrame(r18.xyz, vec3(0.0), true, true);
    lobe0 = dielectricSetup(parameters[3].xyz, parameters[4].x, parameters[5].xy, false, 3, false, 1);
    vec3 coverage0 = lobeFix(lobe0, frames[0].wo, 6, lobeAlbedo[0]);
    coverage0 = unitColor(coverage0);
    lobeTransmittance[0] = fixTransmittance;
    lobe1 = conductorSetup(parameters[71].xyz, parameters[72].xyz, parameters[73].xy, false, 1);
    vec3 coverage1 = lobeFix(lobe1, frames[1].wo, lobeAlbedo[1]);
    coverage1 = unitColor(coverage1);
    vec3 w0 = closureScaled(vec3(1.0), unit(r17.x));
    vec3 w1 = closureRest(vec3(1.0), unit(r17.x));
    lobeWeight[1] = closureScaled(w1, unit(parameters[74].x));
    lobeWeight[0] = closureScaled(w0, unit(parameters[75].x));
    passThrough = vec3(0.0);
}
void materialSetup() {
    instantiate();
    float sum = 0.0;
    int present = 0;
    bool has0 = hasWeight(lobeWeight[0]);
    present += has0 ? 1 : 0;
    bool has1 = hasWeight(lobeWeight[1]);
    present += has1 ? 1 : 0;
    lobeChance[0] = !has0 ? 0.0 : selectionShare(lobeWeight[0], lobeAlbedo[0], present == 1);
    sum += lobeChance[0];
    lobeChance[1] = !has1 ? 0.0 : selectionShare(lobeWeight[1], lobeAlbedo[1], present == 1);
    sum += lobeChance[1];
    lobeChance[0] /= sum > 0.0 ? sum : 1.0;
    if (!(sum > 0.0)) lobeWeight[0] = vec3(0.0);
    lobeChance[1] /= sum > 0.0 ? sum : 1.0;
    if (!(sum > 0.0)) lobeWeight[1] = vec3(0.0);
}
float materialPresence(out vec3 passes) {
    passes = vec3(1.0);
    presentShare = unit(parameters[76].x);
    return presentShare;
}
vec3 materialEmission(vec3 wo) {
    return vec3(0.0);
}
MaterialEval materialEvalBut(vec3 wi, int without) {
    MaterialEval sum = materialEvalNone();
    bool reflects = isReflected(wi, point.geometricNormal, woOutside());
    vec3 wi0 = toLocal(frames[0], wi);
    vec3 wi1 = toLocal(frames[1], wi);
    if (without != 0) addLobe(sum, lobeAgrees(frames[0].wo.z, wi0.z, reflects) && hasWeight(lobeWeight[0]), false, lobeWeight[0], lobeChance[0], dielectricEval(lobe0, frames[0].wo, wi0));
    if (without != 1) addLobe(sum, lobeAgrees(frames[1].wo.z, wi1.z, reflects) && hasWeight(lobeWeight[1]), false, lobeWeight[1], lobeChance[1], conductorEval(lobe1, frames[1].wo, wi1));
    return sum;
}
MaterialEval materialEval(vec3 wi) { return materialEvalBut(wi, -1); }
MaterialSample materialSample(vec3 u, float uLobe) {
    Selection drawn = selectionNone();
    selectLobe(drawn, 0, lobeChance[0], uLobe);
    selectLobe(drawn, 1, lobeChance[1], uLobe);
    MaterialSample s = materialSampleNone();
    LobeSample l = lobeSampleNone();
    vec3 weight = vec3(0.0);
    float chance = 0.0;
    if (drawn.lobe == 0) {
        l = dielectricSample(lobe0, frames[0].wo, u);
        s.wi = toWorld(frames[0], l.wi);
        s.diffuse = false;
        weight = lobeWeight[0];
        chance = lobeChance[0];
    }
    if (drawn.lobe == 1) {
        l = conductorSample(lobe1, frames[1].wo, u);
        s.wi = toWorld(frames[1], l.wi);
        s.diffuse = false;
        weight = lobeWeight[1];
        chance = lobeChance[1];
    }
    return finishSample(s, l, drawn.lobe, weight, chance);
}

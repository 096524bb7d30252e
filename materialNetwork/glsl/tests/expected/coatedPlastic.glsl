layout(std140, binding = 1) uniform Parameters { vec4 parameters[73]; };
vec4 materialParameter(int i) { return parameters[i]; }
DielectricLobe lobe0;
OrenNayarLobe lobe1;
vec3 lobeWeight[2];
vec3 lobeAlbedo[2];
float lobeChance[2];
Frame frames[1];
vec3 passThrough;
void instantiate() {
    frames[0] = makeFrame(vec3(0.0), vec3(0.0), true);
    lobe0 = dielectricSetup(parameters[0].xyz, parameters[1].x, parameters[2].xy, false, 1, false, 1);
    vec3 coverage0 = lobeFix(lobe0, frames[0].wo, 3, lobeAlbedo[0]);
    coverage0 = unit(coverage0);
    lobe1 = orenNayarModel(parameters[68].xyz, parameters[69].x, false, 0);
    vec3 coverage1 = lobeFix(lobe1, frames[0].wo, lobeAlbedo[1]);
    coverage1 = unit(coverage1);
    vec3 kinds0 = layerKinds(lobeRoughness(lobe0), frames[0].wo.z, 0.0);
    vec3 kinds1 = layerKinds(1.0, frames[0].wo.z, 0.0);
    LayerLight light0 = layerOfLobe(lobeAlbedo[0] * unit(parameters[70].x), kinds0);
    LayerLight light1 = layerOfLobe(lobeAlbedo[1] * unit(parameters[71].x), kinds1);
    LayerLight top0 = layerThrough(unit(parameters[70].x), coverage0, layerInsideDielectric(lobe0.favg, lobe0.ior, lobe0.invIor, frames[0].wo.z), lobeRoughness(lobe0), frames[0].wo.z, light1);
    LayerLight through2 = top0;
    LayerLight light2 = layerSum(light0, layerProduct(top0, light1));
    LayerLight w0 = layerEven(vec3(0.0));
    LayerLight w1 = layerEven(vec3(0.0));
    LayerLight w2 = layerEven(vec3(1.0));
    w0 = layerSum(w0, w2);
    w1 = layerSum(w1, layerProduct(w2, through2));
    lobeWeight[1] = layerWeight(w1, kinds1) * unit(parameters[71].x);
    lobeWeight[0] = layerWeight(w0, kinds0) * unit(parameters[70].x);
    passThrough = vec3(0.0);
}
void materialSetup() {
    instantiate();
    float sum = 0.0;
    int present = 0;
    bool has0 = luminance(lobeWeight[0]) > 0.0;
    present += has0 ? 1 : 0;
    bool has1 = luminance(lobeWeight[1]) > 0.0;
    present += has1 ? 1 : 0;
    lobeChance[0] = !has0 ? 0.0 : present == 1 ? 1.0 : luminance(lobeWeight[0] * lobeAlbedo[0]);
    sum += lobeChance[0];
    lobeChance[1] = !has1 ? 0.0 : present == 1 ? 1.0 : luminance(lobeWeight[1] * lobeAlbedo[1]);
    sum += lobeChance[1];
    lobeChance[0] /= sum > 0.0 ? sum : 1.0;
    if (!(sum > 0.0)) lobeWeight[0] = vec3(0.0);
    lobeChance[1] /= sum > 0.0 ? sum : 1.0;
    if (!(sum > 0.0)) lobeWeight[1] = vec3(0.0);
}
float materialPresence(out vec3 passes) {
    passes = vec3(1.0);
    float x = unit(parameters[72].x);
    return x;
}
vec3 materialEmission(vec3 wo) {
    return vec3(0.0);
}
MaterialEval materialEvalBut(vec3 wi, int without) {
    MaterialEval sum = materialEvalNone();
    bool reflects = (dot(wi, point.geometricNormal) > 0.0) == woOutside();
    if (without != 0) addLobe(sum, false, lobeWeight[0], lobeChance[0], reflects, frames[0], wi, dielectricEval(lobe0, frames[0].wo, toLocal(frames[0], wi)));
    if (without != 1) addLobe(sum, true, lobeWeight[1], lobeChance[1], reflects, frames[0], wi, orenNayarEval(lobe1, frames[0].wo, toLocal(frames[0], wi)));
    return sum;
}
MaterialEval materialEval(vec3 wi) { return materialEvalBut(wi, -1); }
MaterialSample materialSample(vec3 u, float uLobe) {
    MaterialSample s = materialSampleNone();
    LobeSample l = lobeSampleNone();
    float below = 0.0, chance = 0.0;
    vec3 weight = vec3(0.0);
    int drawn = -1;
    if (drawn < 0 && lobeChance[0] > 0.0 && uLobe < below + lobeChance[0]) {
        l = dielectricSample(lobe0, frames[0].wo, u);
        s.wi = toWorld(frames[0], l.wi);
        s.diffuse = false;
        drawn = 0;
        weight = lobeWeight[0];
        chance = lobeChance[0];
    }
    below += lobeChance[0];
    if (drawn < 0 && lobeChance[1] > 0.0) {
        l = orenNayarSample(lobe1, frames[0].wo, u);
        s.wi = toWorld(frames[0], l.wi);
        s.diffuse = true;
        drawn = 1;
        weight = lobeWeight[1];
        chance = lobeChance[1];
    }
    below += lobeChance[1];
    return finishSample(s, l, drawn, weight, chance);
}

// SPDX-License-Identifier: Apache-2.0
// Layers that count what the interface on top sends back down to its base: the method `returned` of
// layering. All numbers are shares of light per channel.
//
// Light of three kinds leaves a base: mirrored as in a polished metal, spread as by a diffuse
// surface, and transmitted, which leaves downwards and never comes back. Of what is mirrored the interface
// reflects as much as from outside at the same cosine, E; of what is spread its diffuse reflectance
// from inside, R. Returned light meets the whole base again, so that with A the base's albedo all
// bounces are a geometric series: what enters, 1 - E, counts (1 - R) / (1 - A R) times. Over a white
// base that is 1 - E, whatever R is, and it is never more.

// Of one albedo, or of one weight: a number for light of each kind.
struct LayerLight {
    vec3 mirrored;
    vec3 spread;
    vec3 transmitted;
};

PATINA_FN LayerLight layerLight(vec3 mirrored, vec3 spread, vec3 transmitted) {
    LayerLight l;
    l.mirrored = mirrored;
    l.spread = spread;
    l.transmitted = transmitted;
    return l;
}
PATINA_FN LayerLight layerEven(vec3 x) {
    return layerLight(x, x, x);
}
PATINA_FN LayerLight layerSum(LayerLight a, LayerLight b) {
    return layerLight(a.mirrored + b.mirrored, a.spread + b.spread, a.transmitted + b.transmitted);
}
PATINA_FN LayerLight layerScaled(LayerLight a, vec3 x) {
    return layerLight(a.mirrored * x, a.spread * x, a.transmitted * x);
}
// As closureScaled, closureRest and closureTinted.
PATINA_FN LayerLight layerShare(LayerLight a, float share) {
    return layerScaled(a, vec3(share));
}
PATINA_FN LayerLight layerRest(LayerLight a, float share) {
    return layerScaled(a, vec3(1.0f - share));
}
PATINA_FN LayerLight layerTinted(LayerLight a, vec3 tint) {
    return layerScaled(a, factor(tint));
}
PATINA_FN LayerLight layerProduct(LayerLight a, LayerLight b) {
    return layerLight(a.mirrored * b.mirrored, a.spread * b.spread, a.transmitted * b.transmitted);
}

// The outside of a lobe: alpha of its facets (1 for diffuse), cosine of wo, share that it passes.
// Measured with a random walk between interfaces of ior 1.33 to 2 and metals. Shares of white lobes
// are 1 but for the last digit, which must not make a weight negative, here and below.
const float LAYER_SPREAD = 0.05f;
PATINA_FN vec3 layerKinds(float alpha, float z, float share) {
    float passes = clamp(share, 0.0f, 1.0f);
    if (!(alpha < 1.0f)) return vec3(0.0f, 1.0f - passes, passes);
    float a2 = alpha * alpha;
    float c = min(abs(z), 1.0f);
    float spread = a2 / max(a2 + LAYER_SPREAD * c * c * c, 1e-12f);
    return vec3((1.0f - spread) * (1.0f - passes), spread * (1.0f - passes), passes);
}
// albedo: of a lobe that shows as `kinds`.
PATINA_FN LayerLight layerOfLobe(vec3 albedo, vec3 kinds) {
    return layerLight(albedo * kinds.x, albedo * kinds.y, albedo * kinds.z);
}
PATINA_FN vec3 layerWeight(LayerLight weight, vec3 kinds) {
    return weight.mirrored * kinds.x + weight.spread * kinds.y + weight.transmitted * kinds.z;
}

// The diffuse reflectance of an interface on the far side from wo. average: from outside; by
// reciprocity what is let through by either side differs by the square of the ior ratio.
PATINA_FN vec3 layerInside(vec3 average, float invIor, float z) {
    vec3 inside = 1.0f - (1.0f - average) * (invIor * invIor);
    return min(max(select(inside, average, z >= 0.0f), vec3(0.0f)), vec3(1.0f));
}
// The same for an interface whose average is that of its thinner side, as a dielectric's.
PATINA_FN vec3 layerInsideDielectric(float average, float ior, float invIor, float z) {
    float n = min(ior, invIor);
    float denser = 1.0f - (1.0f - average) * (n * n);
    return vec3(clamp(select(denser, average, (z >= 0.0f) == (ior >= 1.0f)), 0.0f, 1.0f));
}

// Light that reaches the base and leaves it again through an interface with presence `weight`. coverage: E. inside: R.
// alpha: of the interface's facets, which spread refracted light. z: cosine of wo. base: albedo of the base.
PATINA_FN LayerLight layerThrough(float weight, vec3 coverage, vec3 inside, float alpha, float z,
                                  LayerLight base) {
    vec3 kinds = layerKinds(0.5f * alpha, z, 0.0f);
    vec3 covered = min(coverage, vec3(1.0f));
    vec3 mirror = min(covered * kinds.x + inside * kinds.y, vec3(1.0f));
    // Closures that are added may have an albedo above 1: what comes back is that of white ones, in the
    // same parts, so that no more leaves than the base has. What is transmitted is one of these parts: it
    // leaves at every bounce.
    vec3 whole = max(base.mirrored + base.spread + base.transmitted, vec3(1.0f));
    vec3 again = (base.mirrored * mirror + base.spread * inside) / whole;
    vec3 enters = (1.0f - covered) / max(1.0f - again, vec3(1e-6f));
    vec3 bare = vec3(1.0f - weight);
    return layerLight(bare + weight * enters * (1.0f - mirror), bare + weight * enters * (1.0f - inside),
                      bare + weight * enters);
}
// A top that sends nothing back: sheen, what is opaque, and where the model counts it already.
PATINA_FN LayerLight layerPast(float weight, vec3 coverage) {
    return layerEven(max(1.0f - weight * coverage, vec3(0.0f)));
}
PATINA_FN LayerLight layerMix(LayerLight a, LayerLight b, float share) {
    return layerSum(layerScaled(a, vec3(share)), layerScaled(b, vec3(1.0f - share)));
}
// Tops side by side, as added closures are.
PATINA_FN LayerLight layerBeside(LayerLight a, LayerLight b) {
    return layerLight(max(a.mirrored + b.mirrored - 1.0f, vec3(0.0f)),
                      max(a.spread + b.spread - 1.0f, vec3(0.0f)),
                      max(a.transmitted + b.transmitted - 1.0f, vec3(0.0f)));
}
// A top that is there to the share `weight`.
PATINA_FN LayerLight layerCovered(LayerLight a, vec3 weight) {
    return layerSum(layerEven(1.0f - weight), layerScaled(a, weight));
}

// The loss that a coloured share takes from all channels of a base alike.
PATINA_FN vec3 shareLargest(vec3 c) {
    return vec3(unit(largest(c)));
}
PATINA_FN vec3 shareAverage(vec3 c) {
    return vec3(unit((c.x + c.y + c.z) / 3.0f));
}

// Transmittance of tops per channel, without the light that comes back.
PATINA_FN vec3 passLobe(vec3 coverage, float weight) {
    return max(1.0f - weight * coverage, vec3(0.0f));
}
PATINA_FN vec3 passBeside(vec3 a, vec3 b) {
    return max(a + b - 1.0f, vec3(0.0f));
}
PATINA_FN vec3 passCovered(vec3 a, vec3 cover) {
    return 1.0f - cover * (1.0f - a);
}

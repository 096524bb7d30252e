// SPDX-License-Identifier: Apache-2.0
// Adjustments of colours, and compositing.
#ifndef PATINA_NODE_ROWS

PATINA_FN vec4 nodeContrast(vec4 x, vec4 amount, vec4 pivot) {
    return (x - pivot) * amount + pivot;
}

PATINA_FN float rangeOf(float x, float low, float high, float gamma, float outLow, float outHigh,
                        bool clamps) {
    float v = patternRange(x, low, high, gamma, outLow, outHigh);
    return clamps ? min(max(v, outLow), outHigh) : v;
}
PATINA_FN vec4 nodeRange(vec4 x, vec4 low, vec4 high, vec4 gamma, vec4 outLow, vec4 outHigh,
                         bool clamps) {
    return vec4(rangeOf(x.x, low.x, high.x, gamma.x, outLow.x, outHigh.x, clamps),
                rangeOf(x.y, low.y, high.y, gamma.y, outLow.y, outHigh.y, clamps),
                rangeOf(x.z, low.z, high.z, gamma.z, outLow.z, outHigh.z, clamps),
                rangeOf(x.w, low.w, high.w, gamma.w, outLow.w, outHigh.w, clamps));
}

PATINA_FN vec4 nodeSafePower(vec4 x, vec4 e) {
    return vec4(patternSafePower(x.x, e.x), patternSafePower(x.y, e.y), patternSafePower(x.z, e.z),
                patternSafePower(x.w, e.w));
}

PATINA_FN vec4 nodeHsvAdjust(vec4 c, vec3 amount) {
    return vec4(patternHsvAdjust(vec3(c), amount), c.w);
}
PATINA_FN vec4 nodeSaturate(vec4 c, float amount, vec3 coefficients) {
    return vec4(patternSaturate(vec3(c), amount, coefficients), c.w);
}

// In the order hue, saturation, gamma, lift, gain, contrast, exposure.
PATINA_FN vec4 nodeColorCorrect(vec4 c, float hue, float saturation, float gamma, float lift,
                                float gain, float contrast, float pivot, float exposure) {
    vec3 v = patternHsvAdjust(vec3(c), vec3(hue, 1.0f, 1.0f));
    v = patternSaturate(v, saturation, vec3(0.2722287f, 0.6740818f, 0.0536895f));
    v = vec3(patternRange(v.x, 0.0f, 1.0f, gamma, 0.0f, 1.0f),
             patternRange(v.y, 0.0f, 1.0f, gamma, 0.0f, 1.0f),
             patternRange(v.z, 0.0f, 1.0f, gamma, 0.0f, 1.0f));
    v = v * (1.0f - lift) + lift;
    v = (v * gain - pivot) * contrast + pivot;
    return vec4(v * exp2(clamp(exposure, -60.0f, 60.0f)), c.w);
}

PATINA_FN vec4 nodePremultiply(vec4 c) {
    return vec4(vec3(c) * c.w, c.w);
}
PATINA_FN vec4 nodeUnpremultiply(vec4 c) {
    return c.w != 0.0f ? vec4(vec3(c) / c.w, c.w) : vec4(0.0f);
}

PATINA_FN vec4 nodeInside(vec4 x, float mask) {
    return x * mask;
}
PATINA_FN vec4 nodeOutside(vec4 x, float mask) {
    return x * (1.0f - mask);
}

// Blends of a foreground and a background. value: what stands where the share is 1.
PATINA_FN vec4 blended(vec4 value, vec4 bg, float share) {
    return bg + (value - bg) * share;
}
PATINA_FN vec4 nodePlus(vec4 fg, vec4 bg, float share) {
    return blended(bg + fg, bg, share);
}
PATINA_FN vec4 nodeMinus(vec4 fg, vec4 bg, float share) {
    return blended(bg - fg, bg, share);
}
PATINA_FN vec4 nodeDifference(vec4 fg, vec4 bg, float share) {
    return blended(abs(bg - fg), bg, share);
}
PATINA_FN vec4 nodeScreen(vec4 fg, vec4 bg, float share) {
    return blended(1.0f - (1.0f - fg) * (1.0f - bg), bg, share);
}
PATINA_FN float overlaid(float f, float b) {
    return b >= 0.5f ? 1.0f - 2.0f * (1.0f - f) * (1.0f - b) : 2.0f * f * b;
}
PATINA_FN vec4 nodeOverlay(vec4 fg, vec4 bg, float share) {
    return blended(vec4(overlaid(fg.x, bg.x), overlaid(fg.y, bg.y), overlaid(fg.z, bg.z),
                        overlaid(fg.w, bg.w)),
                   bg, share);
}
// Where these two would divide by 0 they give 0, whatever the share is.
PATINA_FN float burnt(float f, float b, float share) {
    return abs(f) < 1e-6f ? 0.0f : b + (1.0f - (1.0f - b) / f - b) * share;
}
PATINA_FN vec4 nodeBurn(vec4 fg, vec4 bg, float share) {
    return vec4(burnt(fg.x, bg.x, share), burnt(fg.y, bg.y, share), burnt(fg.z, bg.z, share),
                burnt(fg.w, bg.w, share));
}
PATINA_FN float dodged(float f, float b, float share) {
    return abs(1.0f - f) < 1e-6f ? 0.0f : b + (b / (1.0f - f) - b) * share;
}
PATINA_FN vec4 nodeDodge(vec4 fg, vec4 bg, float share) {
    return vec4(dodged(fg.x, bg.x, share), dodged(fg.y, bg.y, share), dodged(fg.z, bg.z, share),
                dodged(fg.w, bg.w, share));
}

// Porter and Duff 1984; colours are premultiplied except for matte.
PATINA_FN vec4 nodeOver(vec4 fg, vec4 bg, float share) {
    return blended(fg + bg * (1.0f - fg.w), bg, share);
}
PATINA_FN vec4 nodeIn(vec4 fg, vec4 bg, float share) {
    return blended(fg * bg.w, bg, share);
}
PATINA_FN vec4 nodeOut(vec4 fg, vec4 bg, float share) {
    return blended(fg * (1.0f - bg.w), bg, share);
}
PATINA_FN vec4 nodeMask(vec4 fg, vec4 bg, float share) {
    return blended(bg * fg.w, bg, share);
}
PATINA_FN vec4 nodeMatte(vec4 fg, vec4 bg, float share) {
    return blended(vec4(vec3(fg) * fg.w + vec3(bg) * (1.0f - fg.w), fg.w + bg.w * (1.0f - fg.w)),
                   bg, share);
}
PATINA_FN vec4 disjoint(vec4 fg, vec4 bg) {
    float sum = fg.w + bg.w;
    if (sum <= 1.0f) return vec4(vec3(fg) + vec3(bg), sum);
    if (abs(bg.w) < 1e-6f) return vec4(0.0f, 0.0f, 0.0f, 1.0f);
    return vec4(vec3(fg) + vec3(bg) * ((1.0f - fg.w) / bg.w), 1.0f);
}
PATINA_FN vec4 nodeDisjointOver(vec4 fg, vec4 bg, float share) {
    return blended(disjoint(fg, bg), bg, share);
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

const char* const colors = "color3 color4";
const char* const blendTypes = "float color3 color4";
#define PATINA_LUMA "color3 lumacoeffs=0.2722287 0.6740818 0.0536895"
#define PATINA_BLEND "$ fg=0, $ bg=0, float mix=1"
#define PATINA_ALPHA "color4 fg=0, color4 bg=0, float mix=1"
#define PATINA_CORRECTIONS                                                                         \
    "float hue=0, float saturation=1, float gamma=1, float lift=0, float gain=1, "                 \
    "float contrast=1, float contrastpivot=0.5, float exposure=0"
constexpr Algebra none = Algebra::None;

const NodeRow rows[] = {
    {"ND_contrast_$", "contrast", "$ in=0, $ amount=1, $ pivot=0.5", "$",
     PATINA_PATTERN(nodeContrast), none, allTypes},
    {"ND_contrast_$FA", "contrast", "$ in=0, float amount=1, float pivot=0.5", "$",
     PATINA_PATTERN(nodeContrast), none, tupleTypes},
    {"ND_range_$", "range",
     "$ in=0, $ inlow=0, $ inhigh=1, $ gamma=1, $ outlow=0, $ outhigh=1, boolean doclamp=0", "$",
     PATINA_PATTERN(nodeRange), none, allTypes},
    {"ND_range_$FA", "range",
     "$ in=0, float inlow=0, float inhigh=1, float gamma=1, float outlow=0, float outhigh=1, "
     "boolean doclamp=0",
     "$", PATINA_PATTERN(nodeRange), none, tupleTypes},
    {"ND_safepower_$", "safepower", "$ in1=0, $ in2=1", "$", PATINA_PATTERN(nodeSafePower), none,
     allTypes},
    {"ND_safepower_$FA", "safepower", "$ in1=0, float in2=1", "$", PATINA_PATTERN(nodeSafePower),
     none, tupleTypes},
    {"ND_hsvadjust_$", "hsvadjust", "$ in=0, vector3 amount=0 1 1", "$",
     PATINA_PATTERN(nodeHsvAdjust), none, colors},
    {"ND_saturate_$", "saturate", "$ in=0, float amount=1, " PATINA_LUMA, "$",
     PATINA_PATTERN(nodeSaturate), none, colors},
    {"ND_colorcorrect_color3", "colorcorrect", "color3 in=1, " PATINA_CORRECTIONS, "color3",
     PATINA_PATTERN(nodeColorCorrect)},
    {"ND_colorcorrect_color4", "colorcorrect", "color4 in=1 1 1 0, " PATINA_CORRECTIONS, "color4",
     PATINA_PATTERN(nodeColorCorrect)},
    {"ND_premult_color4", "premult", "color4 in=0 0 0 1", "color4",
     PATINA_PATTERN(nodePremultiply)},
    {"ND_unpremult_color4", "unpremult", "color4 in=0 0 0 1", "color4",
     PATINA_PATTERN(nodeUnpremultiply)},
    {"ND_plus_$", "plus", PATINA_BLEND, "$", PATINA_PATTERN(nodePlus), none, blendTypes},
    {"ND_minus_$", "minus", PATINA_BLEND, "$", PATINA_PATTERN(nodeMinus), none, blendTypes},
    {"ND_difference_$", "difference", PATINA_BLEND, "$", PATINA_PATTERN(nodeDifference), none,
     blendTypes},
    {"ND_screen_$", "screen", PATINA_BLEND, "$", PATINA_PATTERN(nodeScreen), none, blendTypes},
    {"ND_overlay_$", "overlay", PATINA_BLEND, "$", PATINA_PATTERN(nodeOverlay), none, blendTypes},
    {"ND_burn_$", "burn", PATINA_BLEND, "$", PATINA_PATTERN(nodeBurn), none, blendTypes},
    {"ND_dodge_$", "dodge", PATINA_BLEND, "$", PATINA_PATTERN(nodeDodge), none, blendTypes},
    {"ND_over_color4", "over", PATINA_ALPHA, "color4", PATINA_PATTERN(nodeOver)},
    {"ND_in_color4", "in", PATINA_ALPHA, "color4", PATINA_PATTERN(nodeIn)},
    {"ND_out_color4", "out", PATINA_ALPHA, "color4", PATINA_PATTERN(nodeOut)},
    {"ND_mask_color4", "mask", PATINA_ALPHA, "color4", PATINA_PATTERN(nodeMask)},
    {"ND_matte_color4", "matte", PATINA_ALPHA, "color4", PATINA_PATTERN(nodeMatte)},
    {"ND_disjointover_color4", "disjointover", PATINA_ALPHA, "color4",
     PATINA_PATTERN(nodeDisjointOver)},
    {"ND_inside_$", "inside", "$ in=0, float mask=1", "$", PATINA_PATTERN(nodeInside), none,
     blendTypes},
    {"ND_outside_$", "outside", "$ in=0, float mask=0", "$", PATINA_PATTERN(nodeOutside), none,
     blendTypes},
};

#endif

// SPDX-License-Identifier: Apache-2.0
// Adjustments of colours, and compositing.
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

constexpr Pattern contrast = pattern(
    "($0 - $2) * $1 + $2", [](Call c) { c.out() = (c.in(0) - c.in(2)) * c.in(1) + c.in(2); });

/// Inputs (in, inlow, inhigh, gamma, outlow, outhigh, doclamp).
constexpr Pattern range = rarePattern("nodeRange($0, $1, $2, $3, $4, $5, $6.x)", [](Call c) {
    for (int i = 0; i < 4; ++i) {
        const float low = c.in(4)[i], high = c.in(5)[i];
        const float v = sh::patternRange(c.in(0)[i], c.in(1)[i], c.in(2)[i], c.in(3)[i], low, high);
        c.out()[i] = c.x(6) != 0.0f ? glm::min(glm::max(v, low), high) : v;
    }
});

constexpr Pattern safePower = rarePattern("nodeSafePower($0, $1)", [](Call c) {
    for (int i = 0; i < 4; ++i)
        c.out()[i] = sh::patternSafePower(c.in(0)[i], c.in(1)[i]);
});

constexpr Pattern hsvAdjust = pattern("vec4(patternHsvAdjust($0.xyz, $1.xyz), $0.w)", [](Call c) {
    c.out() = vec4(sh::patternHsvAdjust(vec3(c.in(0)), vec3(c.in(1))), c.in(0).w);
});

constexpr Pattern saturate =
    pattern("vec4(patternSaturate($0.xyz, $1.x, $2.xyz), $0.w)", [](Call c) {
        c.out() = vec4(sh::patternSaturate(vec3(c.in(0)), c.x(1), vec3(c.in(2))), c.in(0).w);
    });

/// Inputs (in, hue, saturation, gamma, lift, gain, contrast, contrastpivot, exposure), in the order
/// hue, saturation, gamma, lift, gain, contrast, exposure.
constexpr Pattern colorCorrect =
    rarePattern("nodeColorCorrect($0, $1.x, $2.x, $3.x, $4.x, $5.x, $6.x, $7.x, $8.x)", [](Call c) {
        vec3 v = sh::patternHsvAdjust(vec3(c.in(0)), vec3(c.x(1), 1.0f, 1.0f));
        v = sh::patternSaturate(v, c.x(2), vec3(0.2722287f, 0.6740818f, 0.0536895f));
        for (int i = 0; i < 3; ++i)
            v[i] = sh::patternRange(v[i], 0.0f, 1.0f, c.x(3), 0.0f, 1.0f);
        v = v * (1.0f - c.x(4)) + c.x(4);
        v = (v * c.x(5) - c.x(7)) * c.x(6) + c.x(7);
        c.out() = vec4(v * std::exp2(glm::clamp(c.x(8), -60.0f, 60.0f)), c.in(0).w);
    });

constexpr Pattern premultiply = pattern("vec4($0.xyz * $0.w, $0.w)", [](Call c) {
    c.out() = vec4(vec3(c.in(0)) * c.in(0).w, c.in(0).w);
});

constexpr Pattern unpremultiply =
    pattern("$0.w != 0.0 ? vec4($0.xyz / $0.w, $0.w) : vec4(0.0)", [](Call c) {
        const float a = c.in(0).w;
        c.out() = a != 0.0f ? vec4(vec3(c.in(0)) / a, a) : vec4(0.0f);
    });

/// Blends have (fg, bg, mix); the operator says what stands where mix is 1.
template <vec4 (*F)(const vec4&, const vec4&)> void blend(Call c) {
    c.out() = c.in(1) + (F(c.in(0), c.in(1)) - c.in(1)) * c.x(2);
}
template <float (*F)(float, float)> vec4 each(const vec4& f, const vec4& b) {
    return {F(f.x, b.x), F(f.y, b.y), F(f.z, b.z), F(f.w, b.w)};
}
float plus(float f, float b) {
    return b + f;
}
float minus(float f, float b) {
    return b - f;
}
float difference(float f, float b) {
    return std::fabs(b - f);
}
float screen(float f, float b) {
    return 1.0f - (1.0f - f) * (1.0f - b);
}
float overlay(float f, float b) {
    return b >= 0.5f ? 1.0f - 2.0f * (1.0f - f) * (1.0f - b) : 2.0f * f * b;
}
float burn(float f, float b) {
    return 1.0f - (1.0f - b) / f;
}
float dodge(float f, float b) {
    return b / (1.0f - f);
}
/// Where these two would divide by 0 they give 0, whatever mix is.
constexpr Pattern burnBlend = rarePattern("nodeBurn($0, $1, $2.x)", [](Call c) {
    blend<each<burn>>(c);
    for (int i = 0; i < 4; ++i)
        if (std::fabs(c.in(0)[i]) < 1e-6f) c.out()[i] = 0.0f;
});

constexpr Pattern dodgeBlend = rarePattern("nodeDodge($0, $1, $2.x)", [](Call c) {
    blend<each<dodge>>(c);
    for (int i = 0; i < 4; ++i)
        if (std::fabs(1.0f - c.in(0)[i]) < 1e-6f) c.out()[i] = 0.0f;
});

/// Porter and Duff 1984; colours are premultiplied except for matte.
vec4 over(const vec4& f, const vec4& b) {
    return f + b * (1.0f - f.w);
}
vec4 inAlpha(const vec4& f, const vec4& b) {
    return f * b.w;
}
vec4 outAlpha(const vec4& f, const vec4& b) {
    return f * (1.0f - b.w);
}
vec4 maskAlpha(const vec4& f, const vec4& b) {
    return b * f.w;
}
vec4 matte(const vec4& f, const vec4& b) {
    return {vec3(f) * f.w + vec3(b) * (1.0f - f.w), f.w + b.w * (1.0f - f.w)};
}
vec4 disjointOver(const vec4& f, const vec4& b) {
    const float sum = f.w + b.w;
    if (sum <= 1.0f) return {vec3(f) + vec3(b), sum};
    if (std::fabs(b.w) < 1e-6f) return {0.0f, 0.0f, 0.0f, 1.0f};
    return {vec3(f) + vec3(b) * ((1.0f - f.w) / b.w), 1.0f};
}

constexpr Pattern inside = pattern("$0 * $1.x", [](Call c) { c.out() = c.in(0) * c.x(1); });
constexpr Pattern outside =
    pattern("$0 * (1.0 - $1.x)", [](Call c) { c.out() = c.in(0) * (1.0f - c.x(1)); });

constexpr Pattern plusBlend = pattern("$1 + $0 * $2.x", blend<each<plus>>);
constexpr Pattern minusBlend = pattern("$1 - $0 * $2.x", blend<each<minus>>);
constexpr Pattern differenceBlend =
    pattern("$1 + (abs($1 - $0) - $1) * $2.x", blend<each<difference>>);
constexpr Pattern screenBlend = pattern("$1 + ($0 - $0 * $1) * $2.x", blend<each<screen>>);
constexpr Pattern overlayBlend =
    rarePattern("$1 + (nodeOverlay($0, $1) - $1) * $2.x", blend<each<overlay>>);
constexpr Pattern overBlend = rarePattern("$1 + ($0 + $1 * (1.0 - $0.w) - $1) * $2.x", blend<over>);
constexpr Pattern inBlend = rarePattern("$1 + ($0 * $1.w - $1) * $2.x", blend<inAlpha>);
constexpr Pattern outBlend = rarePattern("$1 + ($0 * (1.0 - $1.w) - $1) * $2.x", blend<outAlpha>);
constexpr Pattern maskBlend = rarePattern("$1 + ($1 * $0.w - $1) * $2.x", blend<maskAlpha>);
constexpr Pattern matteBlend = rarePattern("$1 + (nodeMatte($0, $1) - $1) * $2.x", blend<matte>);
constexpr Pattern disjointOverBlend =
    rarePattern("$1 + (nodeDisjointOver($0, $1) - $1) * $2.x", blend<disjointOver>);

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
    {"ND_contrast_$", "contrast", "$ in=0, $ amount=1, $ pivot=0.5", "$", contrast, none, allTypes},
    {"ND_contrast_$FA", "contrast", "$ in=0, float amount=1, float pivot=0.5", "$", contrast, none,
     tupleTypes},
    {"ND_range_$", "range",
     "$ in=0, $ inlow=0, $ inhigh=1, $ gamma=1, $ outlow=0, $ outhigh=1, boolean doclamp=0", "$",
     range, none, allTypes},
    {"ND_range_$FA", "range",
     "$ in=0, float inlow=0, float inhigh=1, float gamma=1, float outlow=0, float outhigh=1, "
     "boolean doclamp=0",
     "$", range, none, tupleTypes},
    {"ND_safepower_$", "safepower", "$ in1=0, $ in2=1", "$", safePower, none, allTypes},
    {"ND_safepower_$FA", "safepower", "$ in1=0, float in2=1", "$", safePower, none, tupleTypes},
    {"ND_hsvadjust_$", "hsvadjust", "$ in=0, vector3 amount=0 1 1", "$", hsvAdjust, none, colors},
    {"ND_saturate_$", "saturate", "$ in=0, float amount=1, " PATINA_LUMA, "$", saturate, none,
     colors},
    {"ND_colorcorrect_color3", "colorcorrect", "color3 in=1, " PATINA_CORRECTIONS, "color3",
     colorCorrect},
    {"ND_colorcorrect_color4", "colorcorrect", "color4 in=1 1 1 0, " PATINA_CORRECTIONS, "color4",
     colorCorrect},
    {"ND_premult_color4", "premult", "color4 in=0 0 0 1", "color4", premultiply},
    {"ND_unpremult_color4", "unpremult", "color4 in=0 0 0 1", "color4", unpremultiply},
    {"ND_plus_$", "plus", PATINA_BLEND, "$", plusBlend, none, blendTypes},
    {"ND_minus_$", "minus", PATINA_BLEND, "$", minusBlend, none, blendTypes},
    {"ND_difference_$", "difference", PATINA_BLEND, "$", differenceBlend, none, blendTypes},
    {"ND_screen_$", "screen", PATINA_BLEND, "$", screenBlend, none, blendTypes},
    {"ND_overlay_$", "overlay", PATINA_BLEND, "$", overlayBlend, none, blendTypes},
    {"ND_burn_$", "burn", PATINA_BLEND, "$", burnBlend, none, blendTypes},
    {"ND_dodge_$", "dodge", PATINA_BLEND, "$", dodgeBlend, none, blendTypes},
    {"ND_over_color4", "over", PATINA_ALPHA, "color4", overBlend},
    {"ND_in_color4", "in", PATINA_ALPHA, "color4", inBlend},
    {"ND_out_color4", "out", PATINA_ALPHA, "color4", outBlend},
    {"ND_mask_color4", "mask", PATINA_ALPHA, "color4", maskBlend},
    {"ND_matte_color4", "matte", PATINA_ALPHA, "color4", matteBlend},
    {"ND_disjointover_color4", "disjointover", PATINA_ALPHA, "color4", disjointOverBlend},
    {"ND_inside_$", "inside", "$ in=0, float mask=1", "$", inside, none, blendTypes},
    {"ND_outside_$", "outside", "$ in=0, float mask=0", "$", outside, none, blendTypes},
};

} // namespace

NodeRows colorNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

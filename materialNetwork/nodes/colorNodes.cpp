// SPDX-License-Identifier: Apache-2.0
// Adjustments of colours, and compositing.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/color.glsl"
#include "materialNetwork/nodes/patternFunctions.h"
#include "materialNetwork/nodes/nodeTable.h"

namespace patina {

namespace {

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

} // namespace

NodeRows colorNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

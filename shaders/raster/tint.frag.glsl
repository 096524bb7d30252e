// SPDX-License-Identifier: Apache-2.0
// Surfaces that let light pass, where this pass does not show them: the tint over all that is behind them, as
// factors, and the light that their present share gives off nevertheless.
#include "shaders/raster/glow.glsl"
layout(location = 0, index = 0) out vec4 outGlow;
layout(location = 0, index = 1) out vec4 outTint;
void main() {
    setPointFromCamera();
    vec3 passes;
    float shown = materialPresence(passes);
    if (ownRandom(31u) < shown) discard;
    // Where the surface is shown it glows with its whole light: here is what that leaves to the share.
    float glows = max(presentShare - shown, 0.0) / max(1.0 - shown, 1e-6);
    outGlow = vec4(glow() * (glows * exposure), 0.0);
    outTint = vec4(passes, 1.0);
}

// SPDX-License-Identifier: Apache-2.0
// The tint of coloured surfaces over all that is behind them, where this pass does not show them: factors,
// so that their order does not matter.
layout(location = 0) out vec4 outColor;
void main() {
    setPointFromCamera();
    vec3 passes;
    if (isPresent(passes)) discard;
    outColor = vec4(passes, 1.0);
}

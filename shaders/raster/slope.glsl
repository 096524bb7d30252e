// SPDX-License-Identifier: Apache-2.0
// Of a caster: how its depth changes from texel to texel of a shadow map.
layout(location = 0) out vec2 slope;
void writeSlope() {
    slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
}

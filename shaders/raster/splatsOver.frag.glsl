// SPDX-License-Identifier: Apache-2.0
// What splats.frag.glsl has drawn, over a picture: the light that splats add, and factors of what is behind.
layout(binding = 0) uniform sampler2D splatLight;
layout(binding = 1) uniform sampler2D splatLeft; // and the stage that it is of
layout(location = 0) uniform ivec4 stage;        // that is wanted, -1 any; 1: factors alone
layout(location = 0, index = 0) out vec4 outLight;
layout(location = 0, index = 1) out vec4 outLeft;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 left = texelFetch(splatLeft, pixel, 0).xy;
    if (left.x == 1.0 || (stage.x >= 0 && int(left.y) != stage.x)) discard;
    outLight = stage.y == 1 ? vec4(0.0) : texelFetch(splatLight, pixel, 0);
    outLeft = vec4(left.x);
}

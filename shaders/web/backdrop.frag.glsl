// SPDX-License-Identifier: Apache-2.0
// The backdrop of the shape: the environment, or a colour.
precision highp float;
precision highp int;
precision highp sampler2D;
#define PATINA_ALBEDO_TABLE_FETCH
#include "shaders/compat/glsl.glsl"
#include "shaders/web/environment.glsl"
uniform mat4 clipToWorld;
uniform vec3 eye;
uniform vec4 plain; // w: 1 shows this colour instead
in vec2 vClip;
out vec4 outColor; // alpha: what the shape covers
void main() {
    vec4 far = clipToWorld * vec4(vClip, 1.0, 1.0);
    vec3 w = normalize(far.xyz / far.w - eye);
    outColor = vec4(plain.w != 0.0 ? plain.rgb : environmentAt(w, 0.0), 0.0);
}

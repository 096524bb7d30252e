// SPDX-License-Identifier: Apache-2.0
precision highp float;
uniform vec2 jitter;
in vec3 position;
out vec2 vClip;
void main() {
    vClip = position.xy - jitter;
    gl_Position = vec4(position.xy, 1.0, 1.0);
}

// SPDX-License-Identifier: Apache-2.0
out vec2 vWindow;
void main() {
    vWindow = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(vWindow, 0.0, 1.0);
}

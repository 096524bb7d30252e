// SPDX-License-Identifier: Apache-2.0
// GLSL ES 3.00. The world is that of the stage, or a unit shape at the origin.
precision highp float;
uniform mat4 objectToWorld;
uniform mat3 normalToWorld;
uniform mat4 worldToClip;
uniform vec2 jitter; // of the pixel, in clip space

in vec3 position;
in vec3 objectPosition;
in vec3 normal;
in vec4 tangent;
in vec2 uv;
in vec3 color;

out vec3 vPosition;
out vec3 vObjectPosition;
out vec3 vNormal;
out vec4 vTangent;
out vec2 vUv;
out vec3 vColor;

void main() {
    vec4 p = objectToWorld * vec4(position, 1.0);
    vPosition = p.xyz;
    vObjectPosition = objectPosition;
    vNormal = normalToWorld * normal;
    vTangent = vec4(mat3(objectToWorld) * tangent.xyz, tangent.w);
    vUv = uv;
    vColor = color;
    gl_Position = worldToClip * p;
    gl_Position.xy += jitter * gl_Position.w;
}

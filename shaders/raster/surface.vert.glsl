// SPDX-License-Identifier: Apache-2.0
#include "shaders/raster/passBlock.glsl"
#include "shaders/raster/instance.glsl"
#include "shaders/raster/draws.glsl"

#ifdef SHADOW
layout(location = 2) uniform mat4 worldToMap;
layout(location = 6) uniform vec4 towardsLight; // position of the light, or direction where w is 0
layout(location = 3) uniform int category; // of what casts, -1: everything
#include "shaders/raster/links.glsl"
#endif
#if PRIMVARS > 0
layout(std430, binding = 6) readonly buffer Primvars { vec4 primvars[]; };
// Per instance of a draw: in xy the low and high 16 bits of what it has, then PRIMVARS values.
layout(std430, binding = 11) readonly buffer InstanceValues { vec4 instanceValues[]; };
#endif

invariant gl_Position; // depths that were drawn before are met again
#ifndef SHADOW
out float gl_ClipDistance[8];
#endif

out vec3 vPosition;
out vec3 vObjectPosition;
out vec3 vNormal; // of strips: along the curve
out vec2 vAcross; // of strips, see onStrip()
flat out mat3 vNormalMatrix;
flat out float vScale;
flat out ivec4 drawInfo; // random numbers: what triangles are counted from; prim id; flags; first of Triangles
flat out ivec4 vInstance; // id, row of links, bits of primvars that there are, place of the prim
#if PRIMVARS > 0
out vec4 vPrimvars[PRIMVARS];
#endif

void main() {
    vNormalMatrix = mat3(normalColumn0.xyz, normalColumn1.xyz, normalColumn2.xyz);
    vScale = column0.w;
    vObjectPosition = inPosition.xyz;
#ifdef SHADOW
    vPosition = positionFor(towardsLight);
#else
    vPosition = positionFor(isPerspective != 0 ? vec4(eye, 1.0) : vec4(-forward, 0.0));
#endif
    vAcross = onStrip();
    vNormal = inPosition.w != 0.0 ? alongStrip() : vNormalMatrix * inNormal;
#ifndef DEPTH_ONLY
    DrawRecord draw = draws[firstDraw + DRAW_OF_CALL];
    drawInfo = ivec4(draw.rows.x, draw.info.yz, draw.rows.y);
    vInstance = ivec4(instanceIds.xy, draw.info.x, instanceIds.w);
#endif
#if PRIMVARS > 0
    for (int i = 0; i < PRIMVARS; ++i)
        vPrimvars[i] = primvars[draw.rows.z + (gl_VertexID - draw.rows.w) * PRIMVARS + i];
    if (draw.info.w > 0) {
        int at = draw.info.w - 1 + instanceIds.z * (PRIMVARS + 1);
        int own = int(instanceValues[at].x) | int(instanceValues[at].y) << 16;
        vInstance.z |= own;
        for (int i = 0; i < PRIMVARS; ++i)
            if ((own & (1 << i)) != 0) vPrimvars[i] = instanceValues[at + 1 + i];
    }
#endif
#ifdef SHADOW
    gl_Position = worldToMap * vec4(vPosition, 1.0);
    if (!isLinked(instanceIds.y, category)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // clipped
#else
    gl_Position = worldToClip * vec4(vPosition, 1.0);
    for (int i = 0; i < 8; ++i)
        gl_ClipDistance[i] = i < planes ? dot(clipPlanes[i], vec4(vPosition, 1.0)) : 1.0;
#endif
}

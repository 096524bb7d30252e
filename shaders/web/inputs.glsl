// SPDX-License-Identifier: Apache-2.0
// Begins a fragment shader that holds one whole material: the lobes, whose albedo tables are a
// texture, and what the vertex shader gives.
precision highp float;
precision highp int;
precision highp sampler2D;
#define PATINA_ALBEDO_TABLE_FETCH
uniform sampler2D albedoTable;
float albedoTableFetch(int index) {
    return texelFetch(albedoTable, ivec2(index & 1023, index >> 10), 0).x;
}
#include "shaders/raster/material.glsl"

in vec3 vPosition;
in vec3 vObjectPosition;
in vec3 vNormal;
in vec4 vTangent; // w: side of the bitangent
in vec2 vUv;
in vec3 vColor;
uniform mat3 normalToWorld;

// SPDX-License-Identifier: Apache-2.0
// Begins every fragment shader of the material page (GLSL ES 3.00). The albedo tables are a texture.
precision highp float;
precision highp int;
precision highp sampler2D;
#define PATINA_ALBEDO_TABLE_FETCH
uniform sampler2D albedoTable;
float albedoTableFetch(int index) {
    return texelFetch(albedoTable, ivec2(index & 1023, index >> 10), 0).x;
}
#include "shaders/raster/material.glsl"

// The page evaluates samples where it evaluates light: a second copy of all lobes would cost drivers
// as much again to compile. What the drawn lobe has by its own sample waits in the sample.
int drawnLobe = -1;
MaterialSample pendingSample(MaterialSample s, LobeSample l, int drawn, vec3 weight, float chance) {
    bool reflects = (l.event & LOBE_REFLECT) != 0;
    drawnLobe = drawn;
    if (drawn < 0 || l.event == 0 ||
        isReflected(s.wi, point.geometricNormal, woOutside()) != reflects)
        return materialSampleNone();
    s.event = l.event;
    s.pdf = chance * l.pdf;
    bool delta = (l.event & LOBE_DELTA) != 0;
    vec3 own =
        delta ? drawnAlone(weight, l.weight, chance) : drawnValue(weight, l.weight, l.pdf);
    s.diffuseWeight = s.diffuse ? own : vec3(0.0);
    s.specularWeight = s.diffuse ? vec3(0.0) : own;
    return s;
}
#define finishSample pendingSample

in vec3 vPosition;
in vec3 vObjectPosition;
in vec3 vNormal;
in vec4 vTangent; // w: side of the bitangent
in vec2 vUv;
in vec3 vColor;
uniform mat3 normalToWorld;

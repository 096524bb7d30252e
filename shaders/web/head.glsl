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
// as much again to compile.
MaterialSample pendingSample(MaterialSample s, LobeSample l) {
    bool reflects = (l.event & LOBE_REFLECT) != 0;
    if (l.event == 0 || ((dot(s.wi, point.geometricNormal) > 0.0) == woOutside()) != reflects)
        return materialSampleNone();
    s.event = l.event;
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

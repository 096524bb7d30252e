// SPDX-License-Identifier: Apache-2.0
// Light from infinitely far: a map around a vertical axis, and an even part.
#include "shaders/lights/dome.glsl"
uniform sampler2D environmentMap;
uniform mat3 worldToEnvironment;
uniform vec3 environmentScale; // 0: none
uniform vec3 ambient;

vec3 environmentAt(vec3 w, float lod) {
    vec3 map = textureLod(environmentMap, domeTexel(worldToEnvironment * w), lod).rgb;
    return environmentScale * map + ambient;
}

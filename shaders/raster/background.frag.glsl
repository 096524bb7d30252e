// SPDX-License-Identifier: Apache-2.0
// The background, which the camera sees where no surface is: domes, or with LIGHT_SHAPES area lights as solid shapes.
#include "shaders/compat/glsl.glsl"
#define ALL_LIGHTS
#define LIGHT_FILTERS
#include "shaders/raster/pass.glsl"
#include "shaders/raster/cameraRay.glsl"
layout(location = 0) out vec4 outColor;
layout(location = 17) uniform ivec4 shown; // of the lights that cameras see: the first, and how many

#ifdef LIGHT_SHAPES
void main() {
    vec3 start, direction;
    vec2 range = cameraRay(start, direction);
    vec3 color = vec3(0.0);
    float nearest = 1e30;
    float depth = 2.0;
    for (int i = shown.x; i < shown.x + shown.y; ++i) {
        Light l = lights[i];
        float t, density;
        vec3 image;
        if (!lightHit(l, start + direction * range.x, direction, t, density, image)) continue;
        t += range.x;
        if (t >= min(nearest, range.y)) continue;
        nearest = t;
        vec3 left = filtersToCamera((l.flags >> LIGHT_FILTERS_SHIFT) - 1, start + direction * t, direction);
        color = l.radiance * image * shapingFactor(l, -direction) * left;
        vec4 clip = worldToClip * vec4(start + direction * t, 1.0);
        depth = clamp(clip.z / clip.w * 0.5 + 0.5, 0.0, 1.0);
    }
    if (depth > 1.0) discard;
    gl_FragDepth = depth;
    outColor = vec4(color * exposure, 1.0);
}
#else
// All domes together, as the camera sees them.
vec4 skyRadiance(vec3 from, vec3 w, float lod) {
    vec4 sum = vec4(0.0);
    for (int i = shown.x; i < shown.x + shown.y; ++i)
        sum += vec4(radianceOfDome(lights[i], w, lod) * filterFactor(lights[i], from, w, LIGHT_FAR), 1.0);
    return vec4(sum.rgb, min(sum.a, 1.0));
}

void main() {
    vec3 start, direction;
    cameraRay(start, direction);
    vec4 color = skyRadiance(isPerspective != 0 ? eye : start, direction, 0.0);
    gl_FragDepth = 1.0;
    outColor = vec4(color.rgb * exposure, color.a);
}
#endif

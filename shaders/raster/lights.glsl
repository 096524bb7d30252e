// SPDX-License-Identifier: Apache-2.0
// Lights as a pass knows them: those of shaders/lights with their samples, and domes. See
// hdDelegate/raster/lights/rasterLight.h.

#define PATINA_ROW(vector, type, number, initial) vec3 vector; type number;
#define PATINA_NUMBERS(type, a, b, c, d, initial) type a, b, c, d;
struct Light {
#include "shaders/lights/fields.glsl"
#include "shaders/raster/lightFields.glsl"
};
#undef PATINA_ROW
#undef PATINA_NUMBERS
#ifdef ALL_LIGHTS
layout(std430, binding = 4) readonly buffer Lights { Light lights[]; };
#else
// Those that the pass takes: drivers read uniform blocks faster than storage.
layout(std140, binding = 4) uniform Lights { Light lights[208]; }; // LightSampler::maxTaken
#endif
layout(std430, binding = 8) readonly buffer LightTables { vec4 lightTables[]; };

vec4 lightValue(int i) {
    return lightTables[i];
}

// Likewise facts that hold for all lights, see light.glsl. Whether a light is at infinity and not narrow, whether the
// distance of its shadows is limited.
#ifndef PATINA_LIGHT_SKY
#define PATINA_LIGHT_SKY(is) (is)
#endif
#ifndef PATINA_LIGHT_FADES
#define PATINA_LIGHT_FADES(does) (does)
#endif
#include "shaders/lights/light.glsl"
#include "shaders/lights/sphereInside.glsl"
#include "shaders/lights/dome.glsl"

// Samples of spheres serve every point at once.
bool sphereFound(ShapeFrame s, vec3 origin, vec3 direction, out float t, out float density) {
    return sphereLightHit(shapeLocal(s, origin), s.inverse * direction, s.volume, t, density);
}

layout(binding = 16) uniform sampler2DArray domeMaps;
layout(binding = 17) uniform sampler2DArray domeDensities;

vec3 toDome(Light l, vec3 w) {
    return vec3(dot(l.axis0, w), dot(l.axis1, w), dot(l.axis2, w));
}
// lod: of the map's mip chain.
vec3 radianceOfDome(Light l, vec3 w, float lod) {
    if (l.domeLayer < 0.0) return l.domeRadiance;
    return l.domeRadiance * textureLod(domeMaps, vec3(domeTexel(toDome(l, w)), l.domeLayer), lod).rgb;
}
// lod: as radianceOfDome. A lookup into a smaller version of the image must weigh itself by as small
// a one of the density, else what is bright beside it counts twice.
float domePdf(Light l, vec3 w, float lod) {
    if (l.domeLayer < 0.0) return 0.25 * INV_PI;
    float finer = 0.5 * log2(2.0 * max(domeTexels, 1.0)) - log2(float(textureSize(domeDensities, 0).x));
    return textureLod(domeDensities, vec3(domeTexel(toDome(l, w)), l.domeLayer), max(lod - finer, 0.0)).x;
}

#ifdef LIGHT_FILTERS
#include "shaders/raster/lightFilters.glsl"
#else
vec3 filterFactor(Light l, vec3 point, vec3 wi, float reach) {
    return vec3(1.0);
}
#endif

vec3 fromShape(Light l, vec3 v) {
    return l.axis0 * v.x + l.axis1 * v.y + l.axis2 * v.z;
}

// lightFrom() of the light's sample, and with its filters. density: of all samples of the light
vec3 lightSample(Light l, vec3 p, out vec3 wi, out float density, out float reach) {
    vec3 radiance = lightFrom(l, LightSample(l.sampled, l.normal, l.density), p, wi, density, reach);
    if (PATINA_LIGHT_SKY(l.kind == LIGHT_DOME || l.kind == LIGHT_MORE_DOME)) density *= l.domeSamples;
    return radiance == vec3(0.0) ? radiance : radiance * filterFactor(l, p, wi, reach);
}

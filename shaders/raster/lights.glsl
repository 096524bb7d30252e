// SPDX-License-Identifier: Apache-2.0
// Lights as a pass knows them, and their shapes. See hdDelegate/raster/lights/rasterLight.h.

#include "shaders/lights/table.glsl"
#include "shaders/lights/ies.glsl"
#include "shaders/lights/shaping.glsl"
#include "shaders/lights/basis.glsl"
#include "shaders/lights/kinds.glsl"
#include "shaders/lights/shapes.glsl"
#include "shaders/lights/sphereInside.glsl"
#include "shaders/lights/line.glsl"
#include "shaders/lights/distant.glsl"
#include "shaders/lights/dome.glsl"

#define PATINA_ROW(vector, type, number, initial) vec3 vector; type number;
#define PATINA_NUMBERS(type, a, b, c, d, initial) type a, b, c, d;
struct Light {
#include "shaders/raster/lightFields.glsl"
};
#ifdef ALL_LIGHTS
layout(std430, binding = 4) readonly buffer Lights { Light lights[]; };
#else
// Those that the pass takes: drivers read uniform blocks faster than storage.
layout(std140, binding = 4) uniform Lights { Light lights[208]; }; // RasterLights::maxTaken
#endif
layout(std430, binding = 8) readonly buffer LightTables { vec4 lightTables[]; };

bool isAtPlace(Light l) {
    return (l.flags & LIGHT_AT_PLACE) != 0;
}
bool isDelta(Light l) {
    return (l.flags & LIGHT_IS_DELTA) != 0;
}
bool hasCone(Light l) {
    return (l.flags & LIGHT_HAS_CONE) != 0;
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
    float finer = 0.5 * log2(2.0 * max(extra.x, 1.0)) - log2(float(textureSize(domeDensities, 0).x));
    return textureLod(domeDensities, vec3(domeTexel(toDome(l, w)), l.domeLayer), max(lod - finer, 0.0)).x;
}
Shaping shapingOf(Light l) {
    return Shaping(l.shapingAxis, l.shapingX, l.shapingY, l.focusTint, l.focus, hasCone(l), l.coneStart,
                   l.coneEnd);
}

// From a table that begins at a place of lightTables.
vec3 tableValue(int at, TableCell c) {
    return tableMix(c, lightTables[at + c.low].xyz, lightTables[at + c.lowNext].xyz,
                    lightTables[at + c.high].xyz, lightTables[at + c.highNext].xyz);
}

// How far samples are whose light is at infinity.
const float LIGHT_FAR = 1e30;

#ifdef LIGHT_FILTERS
#include "shaders/raster/lightFilters.glsl"
#else
vec3 filterFactor(Light l, vec3 point, vec3 wi, float reach) {
    return vec3(1.0);
}
#endif

vec3 shapingFactor(Light l, vec3 away) {
    Shaping s = shapingOf(l);
    float c = shapingCosine(s, away);
    vec3 f = shapingBeam(s, c);
    if (l.firstProfile < 0) return f;
    float phi = iesAzimuth(s.x, s.y, away);
    return f * tableValue(l.firstProfile, directionCell(l.profileThetas, l.profilePhis, acos(c), phi)).x;
}

ShapeFrame frameOf(Light l) {
    mat3 axes = mat3(l.axis0, l.axis1, l.axis2);
    return ShapeFrame(l.origin, axes, mat3(l.inverse0, l.inverse1, l.inverse2),
                      abs(dot(cross(axes[0], axes[1]), axes[2])));
}
vec3 toShape(Light l, vec3 v) {
    return l.inverse0 * v.x + l.inverse1 * v.y + l.inverse2 * v.z;
}
vec3 fromShape(Light l, vec3 v) {
    return l.axis0 * v.x + l.axis1 * v.y + l.axis2 * v.z;
}

// A rect's image at a position in the shape's coordinates: radiance factor, and density of samples
// relative to uniform.
vec4 imageOfRect(Light l, vec3 q) {
    if (l.firstValue < 0) return vec4(1.0);
    ivec2 size = ivec2(l.columns, l.rows);
    ivec2 cell = clamp(ivec2((0.5 - q.xy) * vec2(size)), ivec2(0), size - 1);
    return vec4(tableValue(l.firstValue, rectTexels(q, size.x, size.y)),
                lightTables[l.firstValue + cell.y * size.x + cell.x].w);
}

// The emission of a glowing triangle in a direction away from it, see RasterEmission.
vec3 emissionOfTriangle(Light l, vec3 away) {
    if (l.firstValue < 0) return vec3(1.0);
    float theta = acos(clamp(dot(away, l.shapingAxis), -1.0, 1.0));
    float phi = atan(dot(away, l.shapingY), dot(away, l.shapingX));
    return tableValue(l.firstValue, directionCell(l.columns, l.rows, theta, phi));
}

// First point of the emitting side that a ray meets; density by solid angle of what samples draw, and
// the factor of the radiance there that is not the shaping's.
bool lightHit(Light l, vec3 origin, vec3 direction, out float t, out float density, out vec3 image) {
    int kind = l.kind;
    image = vec3(1.0);
    if (isDelta(l) || kind >= LIGHT_POINT) return false;
    ShapeFrame s = frameOf(l);
    vec3 o = shapeLocal(s, origin), d = s.inverse * direction, q;
    if (kind == SHAPE_SPHERE) return sphereLightHit(o, d, s.volume, t, density);
    if (!shapeHit(kind, o, d, t, q)) return false;
    float byArea = shapePlaceDensity(kind, s, q);
    if (kind == SHAPE_RECT) {
        vec4 value = imageOfRect(l, q);
        image = value.rgb;
        byArea *= value.w;
    }
    density = areaToSolidAngle(byArea, -direction * t, shapeNormalAt(kind, s, q));
    return density > 0.0;
}

// As lightSample(), without filters.
vec3 unfilteredSample(Light l, vec3 p, out vec3 wi, out float density, out float reach) {
    int kind = l.kind;
    vec3 radiance = l.radiance * l.weight;
    wi = l.sampled;
    reach = LIGHT_FAR;
    density = isDelta(l) ? 1.0 : l.density;
    if (kind == LIGHT_DOME || kind == LIGHT_MORE_DOME) density *= l.domeSamples;
    if (!isAtPlace(l)) return radiance;
    vec3 d = l.sampled - p;
    float d2 = max(dot(d, d), 1e-20);
    reach = sqrt(d2);
    wi = d / reach;
    if (kind == SHAPE_SPHERE) {
        ShapeFrame s = frameOf(l);
        sphereLightHit(shapeLocal(s, p), s.inverse * wi, s.volume, reach, density);
        if (density <= 0.0) return vec3(0.0);
        return radiance * shapingFactor(l, -wi);
    }
    radiance *= shapingFactor(l, -wi);
    if (isDelta(l)) {
        if (kind != LIGHT_LINE) return radiance / d2;
        return radiance / d2 * (lineAcross(l.axis0, wi) / l.density);
    }
    if (kind == SHAPE_RECT && l.firstValue >= 0)
        radiance *= imageOfRect(l, toShape(l, l.sampled - l.origin)).rgb;
    float c = -dot(l.normal, wi);
    if (kind == LIGHT_TRIANGLE) {
        if ((l.flags & LIGHT_TWO_SIDED) != 0) c = abs(c);
        radiance *= emissionOfTriangle(l, -wi);
    }
    if (c <= 0.0) return vec3(0.0);
    density *= d2 / c;
    return radiance;
}

// A light's sample as a point meets it. wi: to it; reach: how far it is; density: of all samples of the
// light, by solid angle, 1 of lights that are no area.
// @returns radiance towards the point, or irradiance of what is no area; with how often the light counts
vec3 lightSample(Light l, vec3 p, out vec3 wi, out float density, out float reach) {
    vec3 radiance = unfilteredSample(l, p, wi, density, reach);
    return radiance == vec3(0.0) ? radiance : radiance * filterFactor(l, p, wi, reach);
}

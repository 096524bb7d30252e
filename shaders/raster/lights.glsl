// SPDX-License-Identifier: Apache-2.0
// Lights as a pass knows them, and their shapes. See hdDelegate/raster/lights/rasterLight.h.

#include "shaders/lights/table.glsl"
#include "shaders/lights/ies.glsl"
#include "shaders/lights/shaping.glsl"
#include "shaders/lights/basis.glsl"
#include "shaders/lights/shapes.glsl"
#include "shaders/lights/sphereInside.glsl"
#include "shaders/lights/line.glsl"
#include "shaders/lights/distant.glsl"
#include "shaders/lights/dome.glsl"

struct Light {
    vec4 sampled;  // xyz: position, or direction to the light; w: 1 position, 0 direction
    vec4 normal;   // of the emitter at the sample; w: density by area, by length, or by solid angle
    vec4 radiance; // w: kind. Of domes that of the sample
    vec4 origin;   // of the shape, or a dome's radiance without its image; w: 1 delta
    vec4 axis0, axis1, axis2;          // shape to world; w: samples that a pixel takes of it (0: one, of a dome cone.y), -, category that is lit (-1 all)
    vec4 inverse0, inverse1, inverse2; // world to shape; w: diffuse, specular, 1 seen by the camera
    vec4 shaping;   // axis; w: focus
    vec4 focusTint; // w: cosine cutoff is on
    vec4 cone;      // x start, y end, radians; z 1 - cos of a distant light, w its solid angle.
                    // Of domes: x layer of the image (-1 none), y samples, z first of its harmonics
                    // (-1 none). Of distant lights: x 1 the sun of a dome. Of triangles: z 1 two-sided
    vec4 shadow;    // x first map (-1 none), y maps (0: the sky's), z for fibres; w 0 parallel, 1 perspective,
                    // from 2 on: perspective, from the place of the light with this number less 2
    vec4 shadowColor; // w: -
    vec4 fade;      // of shadows: distance, falloff, gamma; w: how often the light counts
    vec4 table;     // x first value of an image (-1 none), y width, z height; w first of a profile (-1)
                    // Of triangles: x first of RasterEmission (-1 even), y steps of the angle, z of the turn
    vec4 shapingX;  // local x across the axis; w: thetas of the profile
    vec4 shapingY;  // w: phis
};
#ifdef ALL_LIGHTS
layout(std430, binding = 4) readonly buffer Lights { Light lights[]; };
#else
// Those that the pass takes: drivers read uniform blocks faster than storage.
layout(std140, binding = 4) uniform Lights { Light lights[208]; }; // RasterLights::maxTaken
#endif
layout(std430, binding = 8) readonly buffer LightTables { vec4 lightTables[]; };

// Kinds of shapes.glsl, and:
const int LIGHT_POINT = 100;
const int LIGHT_DISTANT = 101;
const int LIGHT_DOME = 102;
// Found by their samples only: further samples of a dome, lines, glowing triangles.
const int LIGHT_MORE_DOME = 103;
const int LIGHT_LINE = 104;
const int LIGHT_TRIANGLE = 105;

layout(binding = 16) uniform sampler2DArray domeMaps;
layout(binding = 17) uniform sampler2DArray domeDensities;

vec3 toDome(Light l, vec3 w) {
    return vec3(dot(l.axis0.xyz, w), dot(l.axis1.xyz, w), dot(l.axis2.xyz, w));
}
// lod: of the map's mip chain.
vec3 radianceOfDome(Light l, vec3 w, float lod) {
    if (l.cone.x < 0.0) return l.origin.xyz;
    return l.origin.xyz * textureLod(domeMaps, vec3(domeTexel(toDome(l, w)), l.cone.x), lod).rgb;
}
// lod: as radianceOfDome. What looks into a smaller version of the image must weigh itself by as small
// a one of the density, else what is bright beside it counts twice.
float domePdf(Light l, vec3 w, float lod) {
    if (l.cone.x < 0.0) return 0.25 * INV_PI;
    float finer = 0.5 * log2(2.0 * max(extra.x, 1.0)) - log2(float(textureSize(domeDensities, 0).x));
    return textureLod(domeDensities, vec3(domeTexel(toDome(l, w)), l.cone.x), max(lod - finer, 0.0)).x;
}
Shaping shapingOf(Light l) {
    return Shaping(l.shaping.xyz, l.shapingX.xyz, l.shapingY.xyz, l.focusTint.xyz, l.shaping.w,
                   l.focusTint.w > 0.0, l.cone.x, l.cone.y);
}

// From a table that begins at a place of lightTables.
vec3 tableValue(float first, TableCell c) {
    int at = int(first);
    return tableMix(c, lightTables[at + c.low].xyz, lightTables[at + c.lowNext].xyz,
                    lightTables[at + c.high].xyz, lightTables[at + c.highNext].xyz);
}

vec3 shapingFactor(Light l, vec3 away) {
    Shaping s = shapingOf(l);
    float c = shapingCosine(s, away);
    vec3 f = shapingBeam(s, c);
    if (l.table.w < 0.0) return f;
    float phi = iesAzimuth(s.x, s.y, away);
    return f * tableValue(l.table.w, directionCell(int(l.shapingX.w), int(l.shapingY.w), acos(c), phi)).x;
}

ShapeFrame frameOf(Light l) {
    mat3 axes = mat3(l.axis0.xyz, l.axis1.xyz, l.axis2.xyz);
    return ShapeFrame(l.origin.xyz, axes, mat3(l.inverse0.xyz, l.inverse1.xyz, l.inverse2.xyz),
                      abs(dot(cross(axes[0], axes[1]), axes[2])));
}
vec3 toShape(Light l, vec3 v) {
    return l.inverse0.xyz * v.x + l.inverse1.xyz * v.y + l.inverse2.xyz * v.z;
}
vec3 fromShape(Light l, vec3 v) {
    return l.axis0.xyz * v.x + l.axis1.xyz * v.y + l.axis2.xyz * v.z;
}

// A rect's image at a position in the shape's coordinates: radiance factor, and density of samples
// relative to uniform.
vec4 imageOfRect(Light l, vec3 q) {
    if (l.table.x < 0.0) return vec4(1.0);
    ivec2 size = ivec2(l.table.yz);
    int first = int(l.table.x);
    ivec2 cell = clamp(ivec2((0.5 - q.xy) * l.table.yz), ivec2(0), size - 1);
    return vec4(tableValue(l.table.x, rectTexels(q, size.x, size.y)),
                lightTables[first + cell.y * size.x + cell.x].w);
}

// What a glowing triangle gives in a direction away from it, see RasterEmission.
vec3 emissionOfTriangle(Light l, vec3 away) {
    if (l.table.x < 0.0) return vec3(1.0);
    float theta = acos(clamp(dot(away, l.shaping.xyz), -1.0, 1.0));
    float phi = atan(dot(away, l.shapingY.xyz), dot(away, l.shapingX.xyz));
    return tableValue(l.table.x, directionCell(int(l.table.y), int(l.table.z), theta, phi));
}

// First point of the emitting side that a ray meets; density by solid angle of what samples draw, and
// the factor of the radiance there that is not the shaping's.
bool lightHit(Light l, vec3 origin, vec3 direction, out float t, out float density, out vec3 image) {
    int kind = int(l.radiance.w);
    image = vec3(1.0);
    if (l.origin.w > 0.0 || kind >= LIGHT_POINT) return false;
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

// A light's sample as a point meets it. wi: to it; reach: how far it is; density: of all samples of the
// light, by solid angle, 1 of lights that are no area.
// @returns radiance towards the point, or irradiance of what is no area; with how often the light counts
vec3 lightSample(Light l, vec3 p, out vec3 wi, out float density, out float reach) {
    int kind = int(l.radiance.w);
    vec3 radiance = l.radiance.xyz * l.fade.w;
    wi = l.sampled.xyz;
    reach = 1e30;
    density = l.origin.w > 0.0 ? 1.0 : l.normal.w;
    if (kind == LIGHT_DOME || kind == LIGHT_MORE_DOME) density *= l.cone.y;
    if (l.sampled.w == 0.0) return radiance;
    vec3 d = l.sampled.xyz - p;
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
    if (l.origin.w > 0.0) {
        if (kind != LIGHT_LINE) return radiance / d2;
        return radiance / d2 * (lineAcross(l.axis0.xyz, wi) / l.normal.w);
    }
    if (kind == SHAPE_RECT && l.table.x >= 0.0)
        radiance *= imageOfRect(l, toShape(l, l.sampled.xyz - l.origin.xyz)).rgb;
    float c = -dot(l.normal.xyz, wi);
    if (kind == LIGHT_TRIANGLE) {
        if (l.cone.z != 0.0) c = abs(c);
        radiance *= emissionOfTriangle(l, -wi);
    }
    if (c <= 0.0) return vec3(0.0);
    density *= d2 / c;
    return radiance;
}

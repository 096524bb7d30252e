// SPDX-License-Identifier: Apache-2.0
// Lights of hosts that compile GLSL: what a sample brings, and what a ray finds. Before this file a host has `struct Light`,
// made of fields.glsl, and
//   vec4 lightValue(int i)   of the table that lights point into
// and it says how it draws samples of spheres, by
//   bool sphereFound(ShapeFrame s, vec3 origin, vec3 direction, out float t, out float density)
// which gives the first point that a ray meets, and the density by solid angle of its samples in that direction.

// Constants before this file may state facts that hold for all lights: drivers compile code that never runs, and software
// OpenGL runs it. Whether a rect has an image, a light has a profile.
#ifndef PATINA_LIGHT_IMAGE
#define PATINA_LIGHT_IMAGE(has) (has)
#endif
#ifndef PATINA_LIGHT_PROFILE
#define PATINA_LIGHT_PROFILE(has) (has)
#endif
#include "shaders/lights/table.glsl"
#include "shaders/lights/ies.glsl"
#include "shaders/lights/shaping.glsl"
#include "shaders/lights/basis.glsl"
#include "shaders/lights/kinds.glsl"
#include "shaders/lights/shapes.glsl"
#include "shaders/lights/line.glsl"
#include "shaders/lights/distant.glsl"

bool sphereFound(ShapeFrame s, vec3 origin, vec3 direction, out float t, out float density);

// How far samples are whose light is at infinity.
const float LIGHT_FAR = 1e30;

// What is drawn of a light.
struct LightSample {
    vec3 place;    // or the direction to the light
    vec3 normal;   // of the emitter there
    float density; // by area, by length, or by solid angle
};

bool isAtPlace(Light l) {
    return (l.flags & LIGHT_AT_PLACE) != 0;
}
bool isDelta(Light l) {
    return (l.flags & LIGHT_IS_DELTA) != 0;
}
bool hasCone(Light l) {
    return (l.flags & LIGHT_HAS_CONE) != 0;
}

// From a table that begins at a place.
vec3 lightTableAt(int at, TableCell c) {
    return tableMix(c, lightValue(at + c.low).xyz, lightValue(at + c.lowNext).xyz, lightValue(at + c.high).xyz,
                    lightValue(at + c.highNext).xyz);
}

vec3 shapingFactor(Light l, vec3 away) {
    Shaping s = Shaping(l.shapingAxis, l.shapingX, l.shapingY, l.focusTint, l.focus, hasCone(l), l.coneStart, l.coneEnd);
    float c = shapingCosine(s, away);
    vec3 f = shapingBeam(s, c);
    if (!PATINA_LIGHT_PROFILE(l.firstProfile >= 0)) return f;
    float phi = iesAzimuth(s.x, s.y, away);
    return f * lightTableAt(l.firstProfile, directionCell(l.profileThetas, l.profilePhis, acos(c), phi)).x;
}

ShapeFrame frameOf(Light l) {
    mat3 axes = mat3(l.axis0, l.axis1, l.axis2);
    return ShapeFrame(l.origin, axes, mat3(l.inverse0, l.inverse1, l.inverse2),
                      abs(dot(cross(axes[0], axes[1]), axes[2])));
}
vec3 toShape(Light l, vec3 v) {
    return l.inverse0 * v.x + l.inverse1 * v.y + l.inverse2 * v.z;
}

// A rect's image at a position in the shape's coordinates: radiance factor, and density of samples
// relative to uniform.
vec4 imageOfRect(Light l, vec3 q) {
    if (!PATINA_LIGHT_IMAGE(l.firstValue >= 0)) return vec4(1.0);
    ivec2 size = ivec2(l.columns, l.rows);
    ivec2 cell = clamp(ivec2((0.5 - q.xy) * vec2(size)), ivec2(0), size - 1);
    return vec4(lightTableAt(l.firstValue, rectTexels(q, size.x, size.y)),
                lightValue(l.firstValue + cell.y * size.x + cell.x).w);
}

// The emission of a glowing triangle in a direction away from it, as a table over directions has it.
vec3 emissionOfTriangle(Light l, vec3 away) {
    if (l.firstValue < 0) return vec3(1.0);
    float theta = acos(clamp(dot(away, l.shapingAxis), -1.0, 1.0));
    float phi = atan(dot(away, l.shapingY), dot(away, l.shapingX));
    return lightTableAt(l.firstValue, directionCell(l.columns, l.rows, theta, phi));
}

// First point of the emitting side that a ray meets; density by solid angle of what samples draw, and
// the factor of the radiance there that is not the shaping's.
bool lightHit(Light l, vec3 origin, vec3 direction, out float t, out float density, out vec3 image) {
    int kind = l.kind;
    image = vec3(1.0);
    if (isDelta(l) || kind >= LIGHT_POINT) return false;
    ShapeFrame s = frameOf(l);
    if (kind == SHAPE_SPHERE) return sphereFound(s, origin, direction, t, density);
    vec3 q;
    if (!shapeHit(kind, shapeLocal(s, origin), s.inverse * direction, t, q)) return false;
    float byArea = shapePlaceDensity(kind, s, q);
    if (kind == SHAPE_RECT) {
        vec4 value = imageOfRect(l, q);
        image = value.rgb;
        byArea *= value.w;
    }
    density = areaToSolidAngle(byArea, -direction * t, shapeNormalAt(kind, s, q));
    return density > 0.0;
}

// The radiance of a light along a ray; of all but delta lights and domes.
// t: LIGHT_FAR of distant lights; density: as lightHit()
bool lightAlong(Light l, vec3 origin, vec3 direction, out float t, out float density, out vec3 radiance) {
    radiance = l.radiance;
    if (l.kind == LIGHT_DISTANT) {
        t = LIGHT_FAR;
        density = distantPdf(l.versine);
        return distantHit(l.axis2, l.versine, direction);
    }
    vec3 image;
    if (!lightHit(l, origin, direction, t, density, image)) return false;
    radiance *= image * shapingFactor(l, -direction);
    return true;
}

// A light's sample as a point meets it. wi: to it; reach: how far it is; density: of the sample, by solid
// angle, 1 of lights that are no area.
// @returns radiance towards the point, or irradiance of what is no area; with how often the light counts
vec3 lightFrom(Light l, LightSample s, vec3 p, out vec3 wi, out float density, out float reach) {
    int kind = l.kind;
    vec3 radiance = l.radiance * l.weight;
    wi = s.place;
    reach = LIGHT_FAR;
    density = isDelta(l) ? 1.0 : s.density;
    if (!isAtPlace(l)) return radiance;
    vec3 d = s.place - p;
    float d2 = max(dot(d, d), 1e-20);
    reach = sqrt(d2);
    wi = d / reach;
    if (kind == SHAPE_SPHERE) {
        sphereFound(frameOf(l), p, wi, reach, density);
        if (density <= 0.0) return vec3(0.0);
        return radiance * shapingFactor(l, -wi);
    }
    radiance *= shapingFactor(l, -wi);
    if (isDelta(l)) {
        if (kind != LIGHT_LINE) return radiance / d2;
        return radiance / d2 * (lineAcross(l.axis0, wi) / s.density);
    }
    if (PATINA_LIGHT_IMAGE(kind == SHAPE_RECT && l.firstValue >= 0)) radiance *= imageOfRect(l, toShape(l, s.place - l.origin)).rgb;
    float c = -dot(s.normal, wi);
    if (kind == LIGHT_TRIANGLE) {
        if ((l.flags & LIGHT_TWO_SIDED) != 0) c = abs(c);
        radiance *= emissionOfTriangle(l, -wi);
    }
    if (c <= 0.0) return vec3(0.0);
    density *= d2 / c;
    return radiance;
}

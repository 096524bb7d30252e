// SPDX-License-Identifier: Apache-2.0
// Direct lights of the material page: a row of a texture for each, a texel for each row of shaders/lights/fields.glsl. The page
// draws samples of its own for each point, where a pass of the rasterizer has them drawn; and it knows whole meshes.

#define PATINA_ROW(vector, type, number, initial) vec3 vector; type number;
#define PATINA_NUMBERS(type, a, b, c, d, initial) type a, b, c, d;
struct Light {
#include "shaders/lights/fields.glsl"
};
#undef PATINA_ROW
#undef PATINA_NUMBERS

uniform sampler2D lightData;
uniform sampler2D lightTable; // 256 values in a row
uniform int lightCount;

vec4 lightValue(int i) {
    return texelFetch(lightTable, ivec2(i & 255, i >> 8), 0);
}

#include "shaders/lights/light.glsl"

const int TRIANGLES_MET = 64; // samples of the BSDF look for no more

#define PATINA_ROW(vector, type, number, initial) \
    v = texelFetch(lightData, ivec2(texel++, i), 0); l.vector = v.xyz; l.number = type(v.w);
#define PATINA_NUMBERS(type, a, b, c, d, initial) \
    v = texelFetch(lightData, ivec2(texel++, i), 0); l.a = type(v.x); l.b = type(v.y); l.c = type(v.z); l.d = type(v.w);
Light lightAt(int i) {
    Light l;
    vec4 v;
    int texel = 0;
#include "shaders/lights/fields.glsl"
    return l;
}
#undef PATINA_ROW
#undef PATINA_NUMBERS

// Samples of spheres are even over the cone that the sphere fills.
bool sphereFound(ShapeFrame s, vec3 origin, vec3 direction, out float t, out float density) {
    vec3 q;
    density = spherePdf(s, origin, origin + direction);
    return sphereHit(shapeLocal(s, origin), s.inverse * direction, t, q) && density > 0.0;
}

// A point on the triangles of a mesh by their area: corner and running share of it, and two edges of each.
vec3 onTriangles(Light l, vec2 u, out vec3 normal) {
    int low = 0, high = l.columns - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (lightValue(l.firstValue + 3 * middle).w > u.x) high = middle; else low = middle + 1;
    }
    int at = l.firstValue + 3 * low;
    float before = low > 0 ? lightValue(at - 3).w : 0.0;
    vec4 corner = lightValue(at);
    float root = sqrt(clamp((u.x - before) / max(corner.w - before, 1e-20), 0.0, 1.0));
    vec3 e1 = lightValue(at + 1).xyz, e2 = lightValue(at + 2).xyz;
    normal = unitOr(cross(e1, e2), vec3(0.0));
    return corner.xyz + e1 * (1.0 - root) + e2 * (u.y * root);
}

// The nearest triangle along a ray. @returns its distance, 0 for none
float hitTriangles(Light l, vec3 from, vec3 wi, out vec3 normal) {
    float nearest = 0.0;
    normal = vec3(0.0);
    for (int i = 0; i < l.columns; ++i) {
        int at = l.firstValue + 3 * i;
        vec3 e1 = lightValue(at + 1).xyz, e2 = lightValue(at + 2).xyz, o = from - lightValue(at).xyz;
        vec3 p = cross(wi, e2), q = cross(o, e1);
        float det = dot(e1, p), a = dot(o, p) / det, b = dot(wi, q) / det, t = dot(e2, q) / det;
        if (det == 0.0 || a < 0.0 || b < 0.0 || a + b > 1.0 || t <= 0.0) continue;
        if (nearest > 0.0 && t >= nearest) continue;
        nearest = t;
        normal = unitOr(cross(e1, e2), vec3(0.0));
    }
    return nearest;
}

// Whether samples of the BSDF find the light.
bool isMet(Light l) {
    return !isDelta(l) && (l.kind != LIGHT_MESH || l.columns <= TRIANGLES_MET);
}

// What a point draws of a light. False where no part that emits faces it.
bool drawSample(Light l, vec3 from, vec2 u, out LightSample s) {
    s = LightSample(l.origin, vec3(0.0), l.density);
    if (l.kind == LIGHT_POINT) return true;
    if (l.kind == LIGHT_DISTANT) {
        s.place = l.axis2;
        if (isDelta(l)) return true;
        vec3 x = anyTangent(l.axis2);
        s.place = distantSample(LightBasis(x, cross(l.axis2, x), l.axis2), l.versine, u);
        s.density = distantPdf(l.versine);
        return true;
    }
    if (l.kind == LIGHT_LINE) {
        vec3 toLight;
        bool seen = lineSample(l.origin, l.axis0 / l.density, from, u.x, toLight, s.density);
        s.place = from + toLight;
        return seen;
    }
    if (l.kind == LIGHT_MESH) {
        s.place = onTriangles(l, u, s.normal);
        return true;
    }
    ShapeFrame f = frameOf(l);
    if (l.kind == SHAPE_SPHERE) {
        ShapePoint p;
        bool seen = sphereSample(f, from, u, p);
        s = LightSample(p.position, p.normal, p.pdf);
        return seen;
    }
    vec3 q = shapePlace(l.kind, u);
    s = LightSample(l.origin + f.axes * q, shapeNormalAt(l.kind, f, q), shapePlaceDensity(l.kind, f, q));
    return true;
}

// One direction to a light. density: by solid angle, 0 for delta lights.
// @returns radiance from there, for delta lights what arrives across it
vec3 sampleLight(Light l, vec3 from, vec2 u, out vec3 wi, out float density) {
    LightSample s;
    float reach;
    vec3 radiance = vec3(0.0);
    wi = vec3(0.0, 1.0, 0.0);
    density = 0.0;
    if (drawSample(l, from, u, s)) radiance = lightFrom(l, s, from, wi, density, reach);
    if (isDelta(l)) density = 0.0;
    return radiance;
}

// The same light found along wi.
// @returns radiance; density: as sampleLight() would have it, 0 where nothing is found
vec3 foundLight(Light l, vec3 from, vec3 wi, out float density) {
    density = 0.0;
    if (!isMet(l)) return vec3(0.0);
    float t;
    vec3 radiance;
    if (l.kind == LIGHT_MESH) {
        vec3 normal;
        t = hitTriangles(l, from, wi, normal);
        if (t > 0.0) density = areaToSolidAngle(l.density, -wi * t, normal);
        return density > 0.0 ? l.radiance * shapingFactor(l, -wi) : vec3(0.0);
    }
    if (!lightAlong(l, from, wi, t, density, radiance)) density = 0.0;
    return density > 0.0 ? radiance : vec3(0.0);
}

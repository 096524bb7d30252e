// SPDX-License-Identifier: Apache-2.0
// Direct lights of the material page, in a texture, 14 texels in a row for each:
//   0 origin of the shape, kind          1 radiance (of delta lights: irradiance or intensity), on
//   2, 3, 4 axes of the shape, see shaders/lights/shape.glsl; w: area of triangles; volume; versine of a distant
//     light's half angle (0: one direction). Of distant lights 4 is the way that light goes
//   5, 6, 7 their inverse; w: focus; where a cone begins to fade; where it ends (-1: no cone)
//   8 focus tint                         9 shares of diffuse and of specular light
//   10 in lightTable: first value of a rect's image (-1 none), its width and height; of triangles:
//     first value, how many; w: first value of an IES profile (-1 none)
//   11 axis of the shaping     12 x across it, thetas of the profile     13 y across it, phis
#include "shaders/lights/table.glsl"
#include "shaders/lights/ies.glsl"
#include "shaders/lights/shaping.glsl"
#include "shaders/lights/basis.glsl"
#include "shaders/lights/shapes.glsl"
#include "shaders/lights/line.glsl"
#include "shaders/lights/distant.glsl"

uniform sampler2D lightData;
uniform sampler2D lightTable; // 256 values in a row
uniform int lightCount;

// Kinds of shapes.glsl, and:
const int LIGHT_POINT = 100;
const int LIGHT_DISTANT = 101;
const int LIGHT_TRIANGLES = 102;
const int LIGHT_LINE = 103; // all of its length is the first axis
const int TRIANGLES_MET = 64; // samples of the BSDF look for no more

struct PageLight {
    int kind;
    vec3 radiance;
    ShapeFrame shape;
    float area;
    float versine; // of a distant light
    Shaping beam;
    vec2 shares;
    vec4 table;
    int thetas; // of the profile
    int phis;
};

vec4 lightTexel(int light, int i) {
    return texelFetch(lightData, ivec2(i, light), 0);
}

PageLight lightAt(int i) {
    PageLight l;
    vec4 o = lightTexel(i, 0), on = lightTexel(i, 1), x = lightTexel(i, 12), y = lightTexel(i, 13);
    vec4 a0 = lightTexel(i, 2), a1 = lightTexel(i, 3), a2 = lightTexel(i, 4);
    vec4 i0 = lightTexel(i, 5), i1 = lightTexel(i, 6), i2 = lightTexel(i, 7);
    l.kind = int(o.w);
    l.radiance = on.xyz * on.w;
    l.shape = ShapeFrame(o.xyz, mat3(a0.xyz, a1.xyz, a2.xyz), mat3(i0.xyz, i1.xyz, i2.xyz), a1.w);
    l.area = a0.w;
    l.versine = a2.w;
    l.beam = Shaping(lightTexel(i, 11).xyz, x.xyz, y.xyz, lightTexel(i, 8).xyz, i0.w, i2.w >= 0.0, i1.w, i2.w);
    l.shares = lightTexel(i, 9).xy;
    l.table = lightTexel(i, 10);
    l.thetas = int(x.w);
    l.phis = int(y.w);
    return l;
}

vec4 tableValue(int i) {
    return texelFetch(lightTable, ivec2(i & 255, i >> 8), 0);
}

// From a table that begins at a place of lightTable.
vec3 tableValue(float first, TableCell c) {
    int at = int(first);
    return tableMix(c, tableValue(at + c.low).xyz, tableValue(at + c.lowNext).xyz,
                    tableValue(at + c.high).xyz, tableValue(at + c.highNext).xyz);
}

// A rect's image at a place of the shape.
vec3 imageOf(PageLight l, vec3 q) {
    if (l.kind != SHAPE_RECT || l.table.x < 0.0) return vec3(1.0);
    return tableValue(l.table.x, rectTexels(q, int(l.table.y), int(l.table.z)));
}

// A point on triangles by their area.
vec3 onTriangles(PageLight l, vec2 u, out vec3 normal) {
    int first = int(l.table.x), low = 0, high = int(l.table.y) - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (tableValue(first + 3 * middle).w > u.x) high = middle; else low = middle + 1;
    }
    float before = low > 0 ? tableValue(first + 3 * low - 3).w : 0.0;
    vec4 corner = tableValue(first + 3 * low);
    float root = sqrt(clamp((u.x - before) / max(corner.w - before, 1e-20), 0.0, 1.0));
    vec3 e1 = tableValue(first + 3 * low + 1).xyz, e2 = tableValue(first + 3 * low + 2).xyz;
    normal = unitOr(cross(e1, e2), vec3(0.0));
    return corner.xyz + e1 * (1.0 - root) + e2 * (u.y * root);
}

// The nearest triangle along wi. @returns its distance, 0 for none
float hitTriangles(PageLight l, vec3 from, vec3 wi, out vec3 normal) {
    float nearest = 0.0;
    normal = vec3(0.0);
    for (int i = 0; i < int(l.table.y); ++i) {
        int at = int(l.table.x) + 3 * i;
        vec3 e1 = tableValue(at + 1).xyz, e2 = tableValue(at + 2).xyz, o = from - tableValue(at).xyz;
        vec3 p = cross(wi, e2), q = cross(o, e1);
        float det = dot(e1, p), a = dot(o, p) / det, b = dot(wi, q) / det, t = dot(e2, q) / det;
        if (det == 0.0 || a < 0.0 || b < 0.0 || a + b > 1.0 || t <= 0.0) continue;
        if (nearest > 0.0 && t >= nearest) continue;
        nearest = t;
        normal = unitOr(cross(e1, e2), vec3(0.0));
    }
    return nearest;
}

bool isMet(PageLight l) {
    return l.kind != LIGHT_TRIANGLES || int(l.table.y) <= TRIANGLES_MET;
}

vec3 shapingOf(PageLight l, vec3 away) {
    float c = shapingCosine(l.beam, away);
    vec3 f = shapingBeam(l.beam, c);
    if (l.table.w < 0.0) return f;
    float phi = iesAzimuth(l.beam.x, l.beam.y, away);
    return f * tableValue(l.table.w, directionCell(l.thetas, l.phis, acos(c), phi)).x;
}

// One direction to a light. density: by solid angle, 0 for delta lights.
// @returns radiance from there, for delta lights what arrives across it
vec3 sampleLight(PageLight l, vec3 from, vec2 u, out vec3 wi, out float density) {
    density = 0.0;
    if (l.kind == LIGHT_DISTANT) {
        wi = -l.shape.axes[2];
        if (l.versine == 0.0) return l.radiance;
        vec3 x = anyTangent(wi);
        wi = distantSample(LightBasis(x, cross(wi, x), wi), l.versine, u);
        density = distantPdf(l.versine);
        return l.radiance;
    }
    if (l.kind == LIGHT_POINT) {
        vec3 d = l.shape.origin - from;
        float d2 = max(dot(d, d), 1e-20);
        wi = d * inversesqrt(d2);
        return l.radiance / d2 * shapingOf(l, -wi);
    }
    if (l.kind == LIGHT_LINE) {
        float pdf;
        bool seen = lineSample(l.shape.origin, l.shape.axes[0], from, u.x, wi, pdf);
        float d2 = dot(wi, wi);
        wi = unitOr(wi, vec3(0.0, 1.0, 0.0));
        float across = lineAcross(unitOr(l.shape.axes[0], vec3(1.0, 0.0, 0.0)), wi);
        return seen ? l.radiance * (across / (d2 * pdf)) * shapingOf(l, -wi) : vec3(0.0);
    }
    ShapePoint p;
    vec3 image = vec3(1.0);
    if (l.kind == SHAPE_SPHERE) {
        sphereSample(l.shape, from, u, p);
        density = p.pdf;
    } else if (l.kind == LIGHT_TRIANGLES) {
        p.position = onTriangles(l, u, p.normal);
        p.pdf = 1.0 / l.area;
    } else {
        vec3 q = shapePlace(l.kind, u);
        p.position = l.shape.origin + l.shape.axes * q;
        p.normal = shapeNormalAt(l.kind, l.shape, q);
        image = imageOf(l, q);
        p.pdf = shapePlaceDensity(l.kind, l.shape, q);
    }
    if (l.kind != SHAPE_SPHERE) density = areaToSolidAngle(p.pdf, from - p.position, p.normal);
    wi = unitOr(p.position - from, vec3(0.0, 1.0, 0.0));
    return density > 0.0 ? l.radiance * image * shapingOf(l, -wi) : vec3(0.0);
}

// The same light found along wi.
// @returns radiance; density: as sampleLight() would have it
vec3 lightAlong(PageLight l, vec3 from, vec3 wi, out float density) {
    density = 0.0;
    if (l.kind == LIGHT_DISTANT) {
        if (l.versine == 0.0 || !distantHit(-l.shape.axes[2], l.versine, wi)) return vec3(0.0);
        density = distantPdf(l.versine);
        return l.radiance;
    }
    float t;
    vec3 image = vec3(1.0);
    if (l.kind == LIGHT_TRIANGLES) {
        vec3 n;
        t = isMet(l) ? hitTriangles(l, from, wi, n) : 0.0;
        if (t > 0.0) density = areaToSolidAngle(1.0 / l.area, -wi * t, n);
    } else if (l.kind < LIGHT_POINT) {
        vec3 q;
        if (!shapeHit(l.kind, shapeLocal(l.shape, from), l.shape.inverse * wi, t, q)) return vec3(0.0);
        float byArea = l.kind == SHAPE_SPHERE ? 0.0 : shapePlaceDensity(l.kind, l.shape, q);
        density = l.kind == SHAPE_SPHERE
                      ? spherePdf(l.shape, from, from + wi * t)
                      : areaToSolidAngle(byArea, -wi * t, shapeNormalAt(l.kind, l.shape, q));
        image = imageOf(l, q);
    }
    return density > 0.0 ? l.radiance * image * shapingOf(l, -wi) : vec3(0.0);
}

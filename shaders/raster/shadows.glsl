// SPDX-License-Identifier: Apache-2.0
// Shadows of lights' samples, and of directions that are none, by the cells of the sky.
// Defined before: isTube(), planeTowards() and departure() as surface.frag.glsl has them.
layout(std430, binding = 5) readonly buffer ShadowMatrices { mat4 shadowMatrices[]; };
#define PATINA_MATRIX(name) mat4 name;
#define PATINA_ROW(vector, type, number, initial) vec3 vector; type number;
#define PATINA_NUMBERS(type, a, b, c, d, initial) type a, b, c, d;
struct SkyCell {
#include "shaders/raster/skyFields.glsl"
};
#undef PATINA_MATRIX
#undef PATINA_ROW
#undef PATINA_NUMBERS
layout(std430, binding = 10) readonly buffer SkyCells { SkyCell skyCells[]; };
layout(binding = 18) uniform sampler2DArray shadowMaps;
layout(binding = 19) uniform sampler2DArray skyMaps;
layout(binding = 25) uniform sampler2DArray shadowSlopes; // of what shadowMaps show, in depths per texel

// How far the surface that a texel shows lies in front of the point's plane at the point itself, in depths. The
// surface is continued from the middle of the texel by the texels on the side away from the point. Where these
// do not lie in a plane, it is continued only if it is within `close` of the point's plane, by the lesser of the
// two slopes; else the answer is 1, which hides the point.
// offset: of the point from the middle, in texels, up to a half
// tilt: change of the depth of the point's plane from texel to texel
float planeBeside(sampler2DArray maps, ivec3 texel, float front, float depth, vec2 offset, vec2 tilt, float close) {
    ivec2 away = ivec2(offset.x > 0.0 ? -1 : 1, offset.y > 0.0 ? -1 : 1);
    ivec3 x = ivec3(away.x, 0, 0), y = ivec3(0, away.y, 0);
    vec2 near = vec2(texelFetch(maps, texel + x, 0).x, texelFetch(maps, texel + y, 0).x) - front;
    vec2 next = vec2(texelFetch(maps, texel + 2 * x, 0).x, texelFetch(maps, texel + 2 * y, 0).x) - front - near;
    bool plane = all(lessThanEqual(abs(next - near), 0.1 * abs(near) + 1e-6));
    if (!plane && depth - front > close) return 1.0;
    vec2 rise = tilt * vec2(away) - (plane ? near : max(near, next));
    return depth - front - dot(rise, abs(offset));
}

// Whether a map shows nothing in front of a point. The compared depth is that where the plane of the surface
// is in the middle of the texel, not the point: then a surface does not hide itself, without being
// moved by as much as a texel may be wrong, which would be seen where things touch.
// hasSlopes: maps are shadowMaps. n: of the plane; 0 compares the point. minimum: of the bias, which is how exact
// depths are.
float isInFront(bool hasSlopes, sampler2DArray maps, mat4 worldToMap, int layer, vec3 p, vec3 n, float minimum) {
    vec4 clip = worldToMap * vec4(p, 1.0);
    if (clip.w <= 0.0) return 1.0;
    vec3 q = clip.xyz / clip.w;
    if (any(greaterThan(abs(q), vec3(1.0)))) return 1.0;
    vec2 size = vec2(textureSize(maps, 0).xy);
    vec2 texel = min(floor((0.5 * q.xy + 0.5) * size), size - 1.0);
    // The plane's depth is linear over the map.
    vec3 x = cross(n, abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    vec4 alongX = worldToMap * vec4(x, 0.0);
    vec4 alongY = worldToMap * vec4(cross(n, x), 0.0);
    vec3 dx = alongX.xyz - q * alongX.w, dy = alongY.xyz - q * alongY.w;
    float area = dx.x * dy.y - dx.y * dy.x;
    vec2 slope = vec2(dx.z * dy.y - dx.y * dy.z, dx.x * dy.z - dx.z * dy.x) /
                 (abs(area) > 1e-30 ? area : 1e-30);
    float depth = q.z + dot(slope, 2.0 * (texel + 0.5) / size - 1.0 - q.xy);
    // Corners of triangles are rounded to a part of a texel.
    float bias = minimum + 0.04 * (abs(slope.x) + abs(slope.y)) / size.x;
    float front = texelFetch(maps, ivec3(ivec2(texel), layer), 0).x;
    depth = 0.5 * depth + 0.5;
    // Nothing casts where the map is empty, and its slope is what was there before.
    if (front >= 1.0 || depth <= front + bias) return 1.0;
    // Where two surfaces meet, the middle of the texel may show the other one, and the point's plane goes on
    // behind that. Where a surface bends towards the light, the middle is nearer to the light than the plane.
    vec2 offset = (0.5 * q.xy + 0.5) * size - texel - 0.5;
    if (hasSlopes && !isTube()) {
        // The surface in the middle hides the point only if its plane also does so at the point.
        vec2 rise = texelFetch(shadowSlopes, ivec3(ivec2(texel), layer), 0).xy;
        return depth - front + dot(slope / size - rise, offset) <= bias ? 1.0 : 0.0;
    }
    mat4 rows = transpose(worldToMap);
    // Half a texel, as a depth. Fibres, and points without a plane, are compared as they are.
    float close = 0.5 * length(rows[2].xyz - q.z * rows[3].xyz) / (size.x * length(rows[0].xyz - q.x * rows[3].xyz));
    if (isTube() || n == vec3(0.0)) close = 0.0;
    return planeBeside(maps, ivec3(ivec2(texel), layer), front, depth, offset, slope / size, close) <= bias ? 1.0 : 0.0;
}

// Whether a map of the fibres alone shows a point.
bool isShown(mat4 worldToMap, vec3 p) {
    vec4 clip = worldToMap * vec4(p, 1.0);
    return all(lessThan(abs(clip.xyz), vec3(clip.w)));
}

// Which of one or six maps around a place shows a direction from there.
int faceOf(int maps, vec3 d) {
    if (maps <= 1) return 0;
    vec3 a = abs(d);
    return a.x >= a.y && a.x >= a.z ? (d.x > 0.0 ? 0 : 1)
           : a.y >= a.z            ? (d.y > 0.0 ? 2 : 3)
                                   : (d.z > 0.0 ? 4 : 5);
}

// Where a light's maps were drawn from: another sample's place, where it has none of its own.
vec3 shadowOrigin(Light l) {
    return l.mapsFrom >= 0 ? lights[l.mapsFrom].sampled : l.sampled;
}

// Whether a light's sample reaches a point, as far as its maps tell.
float reaches(Light l, vec3 p) {
    vec3 d = p - shadowOrigin(l);
    int map = l.firstMap + faceOf(l.maps, d);
    if (isTube() && l.fibreMaps > 0) {
        int finer = l.firstMap + l.maps + faceOf(l.fibreMaps, d);
        if (isShown(shadowMatrices[finer], p)) map = finer;
    }
    vec3 towards = isAtPlace(l) ? -d : l.sampled;
    return isInFront(true, shadowMaps, shadowMatrices[map], map, p, planeTowards(normalize(towards)), 1e-6);
}

vec2 octahedral(vec3 w) {
    vec3 a = w / (abs(w.x) + abs(w.y) + abs(w.z));
    vec2 sides = vec2(a.x >= 0.0 ? 1.0 : -1.0, a.y >= 0.0 ? 1.0 : -1.0);
    return 0.5 + 0.5 * (a.z >= 0.0 ? a.xy : (1.0 - abs(a.yx)) * sides);
}

// Whether light from infinitely far comes to the point along wi, by the map of the cell that wi is
// in: right but for what is thinner than a cell is wide.
float skyReaches(vec3 wi) {
    if (skySide == 0) return 1.0;
    // A direction beside the sample's may be under the surface's horizon where the sample is not: then
    // one further up is asked.
    vec3 up = dot(wi, point.geometricNormal) < 0.0 ? -point.geometricNormal : point.geometricNormal;
    int cell = 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 at = min(ivec2(octahedral(wi + up * (0.2 * float(i))) * float(skySide)), ivec2(skySide - 1));
        cell = at.y * skySide + at.x;
        if (dot(skyCells[cell].towards, up) > 0.0) break;
    }
    mat4 m = skyCells[cell].worldToMap;
    int layer = skyCells[cell].layer;
    vec3 towards = skyCells[cell].towards, p = departure(towards);
    if (isTube() && skyCells[cell].fibreLayer >= 0 && isShown(skyCells[cell].worldToFibres, p)) {
        m = skyCells[cell].worldToFibres;
        layer = skyCells[cell].fibreLayer;
    }
    // These texels are wide: the plane of what is small or round reaches through what is near. So a point
    // above the surface is compared too, without a plane. It is a loop since drivers copy a function to each of
    // its calls.
    float texel = 2.0 / (float(textureSize(skyMaps, 0).x) * length(vec3(m[0].x, m[1].x, m[2].x)));
    vec3 n = isTube() ? planeTowards(towards) : up;
    float seen = 1.0;
    for (int i = 0; i < (isTube() ? 1 : 2) && seen > 0.0; ++i) {
        seen = isInFront(false, skyMaps, m, layer, p, n, 3e-5);
        p = point.position + up * (0.9 * texel);
        n = vec3(0.0);
    }
    return seen;
}

// Share of a light's sample that arrives, by maps of its own; the colour of shadows where it does not.
vec3 shadowByMaps(Light l, vec3 wi) {
    vec3 p = departure(wi);
    float away = isAtPlace(l) ? length(point.position - shadowOrigin(l)) : 1.0;
    // The surface nearest to the light is further off than h where the point moved by h is lit. The first step
    // moves nothing.
    int steps = !PATINA_LIGHT_FADES(l.shadowDistance > 0.0) ? 0 : l.shadowFalloff > 0.0 ? 8 : 1;
    float start = l.shadowFalloff > 0.0 ? max(l.shadowDistance - l.shadowFalloff, 0.0) : l.shadowDistance;
    float h = 0.0, blocked = 0.0, last = 1.0, depth = 1.0;
    for (int i = -1; i < steps && last > 0.0; ++i) {
        float now = i >= 0 && isAtPlace(l) && h >= away ? 0.0 : min(1.0 - reaches(l, p + wi * h), last);
        if (i >= 0) {
            blocked += (last - now) * depth;
            depth = steps > 1 ? pow(clamp((l.shadowDistance - h) / l.shadowFalloff, 0.0, 1.0), l.shadowGamma) : 0.0;
        }
        last = now;
        h = steps > 1 ? mix(start, l.shadowDistance, (float(i) + 1.5) / float(steps)) : start;
    }
    return mix(l.shadowColor, vec3(1.0), 1.0 - (steps > 0 ? blocked : last));
}

// The same for a light with maps of its own, of the sky, or with none.
vec3 shadowAt(Light l, vec3 wi) {
    if (l.firstMap < 0) return vec3(1.0);
    if (PATINA_LIGHT_SKY(l.maps == 0)) return mix(l.shadowColor, vec3(1.0), skyReaches(wi));
    return shadowByMaps(l, wi);
}

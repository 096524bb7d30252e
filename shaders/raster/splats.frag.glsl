// SPDX-License-Identifier: Apache-2.0
// The kernels of splats along each pixel's ray, up to the surface that the depths show. AOVS: where they leave less
// than half of the light.
#include "shaders/compat/glsl.glsl"
#include "shaders/raster/passBlock.glsl"
#include "shaders/raster/cameraRay.glsl"
#include "shaders/lib/splat.glsl"

struct Kernel { // of hdDelegate/compiled/splatKernels.h
    vec4 rows[4];
};
struct Place {
    mat4 toLocal;
    ivec4 harmonics; // first float, coefficients of a particle (0: grey), first row of colours (-1: none), matte
    ivec4 ids;       // primId
};
layout(std430, binding = 0) readonly buffer Kernels { Kernel kernels[]; };
layout(std430, binding = 2) readonly buffer Places { Place places[]; };
layout(std430, binding = 3) readonly buffer Entries { uvec2 entries[]; }; // place, kernel
layout(std430, binding = 6) readonly buffer Tiles { uint firsts[]; };
layout(binding = 0) uniform sampler2D sceneDepth;
layout(location = 0) uniform ivec4 tiles; // pixels of a side; how many across; 1: only where depths are before depthBehind
#ifdef AOVS
layout(location = 0) out vec4 outPosition;
layout(location = 1) out vec4 outNormal;
layout(location = 2) out ivec4 outIds;
#if AOVS > 0
layout(location = 3) out vec4 outOthers[AOVS];
#endif
#else
layout(std430, binding = 1) readonly buffer Harmonics { float harmonics[]; };
layout(std430, binding = 12) readonly buffer Tables { vec4 tables[]; };
layout(binding = 1) uniform sampler2D depthBehind;
layout(location = 0) out vec4 outLight; // alpha of what is no matte
layout(location = 1) out vec2 outLeft;  // of the light behind; tiles.z

const int TABLE_ROWS = 4096; // as RasterSplats::addTable() has them
const float TABLE_END = 16.0;

vec3 converted(int table, vec3 color) {
    vec3 sum = vec3(0.0);
    for (int channel = 0; channel < 3; ++channel) {
        float row = min(sqrt(color[channel] / TABLE_END) * float(TABLE_ROWS - 1), float(TABLE_ROWS - 2));
        int below = table + channel * TABLE_ROWS + int(row);
        vec2 at = vec2(floor(row), floor(row) + 1.0) / float(TABLE_ROWS - 1);
        at = TABLE_END * at * at;
        sum += mix(tables[below].rgb, tables[below + 1].rgb, (color[channel] - at.x) / (at.y - at.x));
    }
    return sum;
}

SplatBasis basis;

vec3 coefficient(int first) {
    return vec3(harmonics[first], harmonics[first + 1], harmonics[first + 2]);
}

// Radiance of a kernel in the direction of basis.
vec3 radianceOf(ivec4 of, int particle) {
    vec3 sum = vec3(0.5);
    int first = of.x + 3 * of.y * particle;
    if (of.y > 0) sum += basis.at[0] * coefficient(first);
    if (of.y > 1)
        for (int i = 1; i < 4; ++i)
            sum += basis.at[i] * coefficient(first + 3 * i);
    if (of.y > 4)
        for (int i = 4; i < 9; ++i)
            sum += basis.at[i] * coefficient(first + 3 * i);
    if (of.y > 9)
        for (int i = 9; i < 16; ++i)
            sum += basis.at[i] * coefficient(first + 3 * i);
    sum = max(sum, vec3(0.0));
    return of.z < 0 ? sum : converted(of.z, sum);
}
#endif

// Kernels come in the order of another ray of the tile. Each waits for some that come after it.
const int WAITING = 24;
struct Met {
    float distance, alpha;
    int entry;
};
#define WAIT(i) if (met.distance >= waiting[i].distance) { Met farther = met; met = waiting[i]; waiting[i] = farther; }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 start, direction;
    vec2 range = cameraRay(start, direction);
    float depth = texelFetch(sceneDepth, pixel, 0).x;
#ifndef AOVS
    if (tiles.z == 1 && !(depth < texelFetch(depthBehind, pixel, 0).x)) discard;
#endif
    if (depth < 1.0) {
        vec4 world = clipToWorld * vec4(vWindow, depth * 2.0 - 1.0, 1.0);
        range.y = min(range.y, dot(world.xyz / world.w - start, direction));
    }
    Met waiting[WAITING];
    for (int i = 0; i < WAITING; ++i)
        waiting[i] = Met(-1e38, 0.0, -1);
    float left = 1.0;
    vec4 light = vec4(0.0);
    uint place = 0xffffffffu, placeSeen = 0xffffffffu;
    vec3 origin, along;
    int tile = pixel.y / tiles.x * tiles.y + pixel.x / tiles.x;
    int end = int(firsts[tile + 1]);
    for (int e = int(firsts[tile]); e < end + WAITING && left > 0.0; ++e) {
        Met met = Met(1e38, 0.0, -1);
        if (e < end) {
            uvec2 entry = entries[e];
            if (entry.x != place) {
                place = entry.x;
                origin = (places[place].toLocal * vec4(start, 1.0)).xyz;
                along = mat3(places[place].toLocal) * direction;
            }
            Kernel k = kernels[entry.y];
            mat3 toUnit = mat3(k.rows[1].xyz, vec3(k.rows[1].w, k.rows[2].xy), vec3(k.rows[2].zw, k.rows[3].x));
            int shape = floatBitsToInt(k.rows[3].w);
            SplatPoint point = splatPoint(shape, k.rows[0].xyz, toUnit, origin, along);
            if (!(point.away < k.rows[3].y && point.distance >= range.x && point.distance <= range.y)) continue;
            met = Met(point.distance, splatAlpha(shape, k.rows[0].w, point.away), e);
        }
        // Written out, since llvmpipe counts the turns of all loops together, and ends them after some 16000.

        WAIT(23) WAIT(22) WAIT(21) WAIT(20) WAIT(19) WAIT(18) WAIT(17) WAIT(16)
        WAIT(15) WAIT(14) WAIT(13) WAIT(12) WAIT(11) WAIT(10) WAIT(9) WAIT(8)
        WAIT(7) WAIT(6) WAIT(5) WAIT(4) WAIT(3) WAIT(2) WAIT(1) WAIT(0)
        if (met.alpha == 0.0) continue;
        float share = left * met.alpha;
        left *= 1.0 - met.alpha;
        uvec2 entry = entries[met.entry];
#ifdef AOVS
        if (left < 0.5) {
            outPosition = vec4(start + direction * met.distance, 1.0);
            outNormal = vec4(0.0);
            outIds = ivec4(places[entry.x].ids.x, -1, -1, -1);
#if AOVS > 0
            for (int i = 0; i < AOVS; ++i)
                outOthers[i] = vec4(0.0);
#endif
            return;
        }
#else
        ivec4 of = places[entry.x].harmonics;
        if (of.w == 0) {
            if (entry.x != placeSeen) {
                placeSeen = entry.x;
                basis = splatBasis(normalize(mat3(places[placeSeen].toLocal) * direction));
            }
            light += share * vec4(radianceOf(of, floatBitsToInt(kernels[entry.y].rows[3].z)), 1.0);
        }
#endif
        if (left < SPLAT_END) left = 0.0;
    }
#ifdef AOVS
    discard;
#else
    outLight = vec4(light.rgb * exposure, light.a);
    outLeft = vec2(left, float(tiles.z));
#endif
}

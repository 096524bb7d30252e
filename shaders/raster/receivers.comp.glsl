// SPDX-License-Identifier: Apache-2.0
// The box around all that the camera sees, as far as its samples reach, and the one around its fibres.
#include "shaders/compat/glsl.glsl"
#include "shaders/raster/passBlock.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D places; // w: 0 nothing, 1 a surface, 2 a fibre
layout(std430, binding = 6) buffer Receivers { uint bounds[12]; }; // low and high of all, low and high of fibres
layout(location = 0) uniform vec2 lens; // radius, distance of what is sharp
const int EACH = 4; // pixels of an invocation along a side
shared uint found[12];

// Numbers in the order of floats.
uint ordered(float x) {
    uint bits = floatBitsToUint(x);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void main() {
    uint own = gl_LocalInvocationIndex;
    if (own < 12u) found[own] = (own / 3u) % 2u == 0u ? 0xffffffffu : 0u;
    barrier();
    ivec2 first = ivec2(gl_GlobalInvocationID.xy) * EACH, end = min(first + EACH, textureSize(places, 0));
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            vec4 p = texelFetch(places, ivec2(x, y), 0);
            if (!(p.w > 0.0) || isnan(p.x + p.y + p.z) || isinf(p.x + p.y + p.z)) continue;
            float away = length(p.xyz - eye);
            // Samples beside the pixel's centre, through the lens too.
            float beside = 2.0 * (isPerspective != 0 ? away : 1.0) * pixelSpread;
            if (lens.x > 0.0) beside += lens.x * abs(away / lens.y - 1.0);
            for (int of = 0; of < (p.w > 1.5 ? 2 : 1); ++of)
                for (int i = 0; i < 3; ++i) {
                    atomicMin(found[6 * of + i], ordered(p[i] - beside));
                    atomicMax(found[6 * of + 3 + i], ordered(p[i] + beside));
                }
        }
    barrier();
    if (own < 12u) {
        if ((own / 3u) % 2u == 0u)
            atomicMin(bounds[own], found[own]);
        else
            atomicMax(bounds[own], found[own]);
    }
}

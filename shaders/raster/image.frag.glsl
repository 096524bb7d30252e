// SPDX-License-Identifier: Apache-2.0
// One AOV of the image as somebody wants its pixels. IDS: as integers; DEPTHS: in a texture of depths.
layout(binding = 0) uniform sampler2D sums; // of passes
layout(binding = 1) uniform sampler2D smoothings;
layout(binding = 2) uniform sampler2D firsts;
layout(binding = 3) uniform sampler2D places; // w: 0 where nothing is
layout(binding = 4) uniform isampler2D ids;
layout(location = 0) uniform ivec4 window; // the pixels that are drawn, the last ones too
layout(location = 1) uniform ivec4 options; // what is wanted; 1 to turn rows around; negative light is right; component of ids, or 1 for what halves hold
layout(location = 2) uniform vec4 shares; // weight of the passes in the sums; of what smoothing does; of the first image
#ifdef IDS
layout(location = 3) uniform int nothing; // of pixels that show nothing
#else
layout(location = 3) uniform vec4 other; // a colour's background, or in x of pixels that show nothing
#endif
layout(location = 4) uniform mat4 worldToCamera;
layout(location = 8) uniform vec4 range; // near, far; 1 orthographic; 1 distances from the camera's centre
#ifdef IDS
layout(location = 0) out ivec4 outValue;
#elif !defined(DEPTHS)
layout(location = 0) out vec4 outValue;
#endif
#ifndef IDS
// As RasterImage::Wanted has them.
const int COLOR = 0, ALPHA = 1, WINDOW_DEPTH = 2, AXIS_DEPTH = 3, CENTRE_DEPTH = 4;

vec4 colorOf(ivec2 pixel) {
    vec4 sum = texelFetch(sums, pixel, 0), mean = vec4(0.0);
    if (shares.x > 0.0) {
        mean = sum / shares.x;
        if (shares.y > 0.0) mean.rgb += texelFetch(smoothings, pixel, 0).rgb * (shares.y / shares.x);
    }
    if (shares.z > 0.0) {
        vec4 first = texelFetch(firsts, pixel, 0);
        mean = vec4(mix(mean.rgb, first.rgb, shares.z), shares.x > 0.0 ? mean.a : first.a);
    }
    if (options.z == 0) mean.rgb = max(mean.rgb, vec3(0.0));
    return mean;
}

float depthOf(vec3 p) {
    float z = range.w != 0.0 ? length(p) : -p.z;
    if (options.x == AXIS_DEPTH) return -p.z;
    if (options.x == CENTRE_DEPTH) return length(p);
    float inside = z - range.x, whole = range.y - range.x;
    if (range.z != 0.0) return clamp(inside / whole, 0.0, 1.0);
    return z > 0.0 ? clamp(range.y * inside / (z * whole), 0.0, 1.0) : 0.0;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (options.y != 0) pixel.y = textureSize(sums, 0).y - 1 - pixel.y;
    bool drawn = !(any(lessThan(pixel, window.xy)) || any(greaterThan(pixel, window.zw)));
    vec4 place = texelFetch(places, pixel, 0);
    drawn = drawn && place.w > 0.0;
#ifdef IDS
    outValue = ivec4(drawn ? texelFetch(ids, pixel, 0)[options.w] : nothing);
#else
#ifdef DEPTHS
    vec4 outValue;
#endif
    vec4 color = options.x <= ALPHA ? colorOf(pixel) : vec4(0.0);
    if (options.x == COLOR)
        outValue = color + (1.0 - color.a) * other;
    else if (options.x == ALPHA)
        outValue = vec4(color.a == 0.0 ? other.x : color.a);
    else
        outValue = vec4(drawn ? depthOf((worldToCamera * vec4(place.xyz, 1.0)).xyz) : other.x);
    if (options.w != 0) outValue = clamp(outValue, vec4(-65504.0), vec4(65504.0));
#ifdef DEPTHS
    gl_FragDepth = outValue.x;
#endif
#endif
}

// SPDX-License-Identifier: Apache-2.0
// What each pixel of the image takes of one pass (takeSplats() of rasterFilterSplat.h, in OpenGL's order of rows), and of
// what smoothing does to it. Blending adds both to their sums.
layout(binding = 0) uniform sampler2D passImage;
layout(binding = 1) uniform sampler2D difference;
layout(location = 0) uniform ivec4 window; // the pixels that are drawn, the last ones too
layout(location = 1) uniform ivec4 options; // border; 0 or, with the smoothing, 1 beside or 2 in the value; negative light is right
layout(location = 2) uniform vec2 splats[17];
layout(location = 0) out vec4 outValue;
layout(location = 1) out vec4 outSmoothing;

bool isNumber(float x) {
    return !isnan(x) && !isinf(x);
}

bool broken(vec4 v) {
    return !isNumber(v.x + v.y + v.z + v.w);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (any(lessThan(pixel, window.xy)) || any(greaterThan(pixel, window.zw))) discard;
    int border = options.x;
    vec4 value = vec4(0.0), smoothing = vec4(0.0);
    for (int j = 0; j <= 2 * border; ++j)
        for (int i = 0; i <= 2 * border; ++i) {
            float weight = splats[i].x * splats[j].y;
            if (weight == 0.0) continue;
            ivec2 from = pixel + ivec2(2 * border - i, j);
            vec4 v = texelFetch(passImage, from, 0);
            vec4 d = options.y > 0 ? texelFetch(difference, from, 0) : vec4(0.0);
            if (options.y == 2) v += vec4(d.rgb, 0.0);
            if (border == 0 || !broken(v)) value += weight * v;
            if (!broken(d)) smoothing += weight * d;
        }
    vec4 own = texelFetch(passImage, pixel + border, 0);
    if (options.y == 2) own.rgb += texelFetch(difference, pixel + border, 0).rgb;
    // A sample that no film takes counts as black; its alpha stays where that is a number.
    vec3 light = options.z != 0 ? abs(value.rgb) : value.rgb;
    bool alpha = isNumber(value.a) && value.a >= 0.0;
    if (!alpha) value.a = 0.0;
    if (!alpha || broken(own) || broken(vec4(light, 0.0)) || any(lessThan(light, vec3(0.0)))) value.rgb = vec3(0.0);
    outValue = value;
    outSmoothing = options.y == 1 ? vec4(smoothing.rgb, 0.0) : vec4(0.0);
}

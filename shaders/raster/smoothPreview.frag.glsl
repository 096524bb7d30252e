// SPDX-License-Identifier: Apache-2.0
// A preview: pixels find light by different samples, so each takes the mean of what its neighbours on the
// same surface find, beside how light they are themselves. Gives the difference that this makes.
#include "shaders/compat/glsl.glsl"
#include "shaders/raster/passBlock.glsl"
layout(binding = 21) uniform sampler2D noisyLight;
layout(binding = 22) uniform sampler2D guides; // w: prim, 0 none
layout(binding = 23) uniform sampler2D places;
layout(binding = 24) uniform sampler2D normals;
layout(location = 0) out vec4 outLight;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(noisyLight, 0) - 1;
    vec4 guide = texelFetch(guides, pixel, 0);
    if (guide.w == 0.0) discard;
    vec3 p = texelFetch(places, pixel, 0).xyz, n = texelFetch(normals, pixel, 0).xyz;
    float wide = pixelSpread * (isPerspective != 0 ? length(eye - p) : 1.0);
    vec3 light = vec3(0.0), guided = vec3(0.0);
    float sum = 0.0;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            ivec2 there = pixel + ivec2(i, j);
            if (any(lessThan(there, ivec2(0))) || any(greaterThan(there, last))) continue;
            vec4 other = texelFetch(guides, there, 0);
            if (other.w != guide.w) continue;
            vec3 m = texelFetch(normals, there, 0).xyz;
            // Strips of hair have none.
            float alike = n == vec3(0.0) ? 1.0 : max(dot(n, m), 0.0);
            alike *= alike;
            alike *= alike;
            alike *= alike;
            float away = dot(n, texelFetch(places, there, 0).xyz - p) / (wide * (1.0 + length(vec2(i, j))));
            // Of the eight parts of the samples (x + 3 y modulo 8) these two corners have the same.
            float weight = alike * alike * exp(-away * away) * (i == j && i != 0 ? 0.5 : 1.0);
            light += weight * texelFetch(noisyLight, there, 0).rgb;
            guided += weight * other.rgb;
            sum += weight;
        }
    sum = max(sum, 1e-20);
    const float minimum = 0.02; // of guides, lest what has nearly none shines
    vec3 smoothed = light / sum * (guide.rgb + minimum) / (guided / sum + minimum);
    outLight = vec4(smoothed - texelFetch(noisyLight, pixel, 0).rgb, 0.0);
}

// SPDX-License-Identifier: Apache-2.0
// Ends a shader that shows one material under one distant light and in even light from all around,
// of which it takes one sample: the mean over `pass` is the picture. It stands for the host's own
// integrator, which calls the same functions: setPoint(), materialPresence(), materialEmission(),
// materialSetup(), and then materialEval() and materialSample() as often as it likes.
#include "shaders/web/point.glsl"
#include "shaders/web/random.glsl"

uniform vec3 eye;             // camera, in world space
uniform float pixelAngle;     // radians across a pixel
uniform vec3 lightDirection;  // unit vector to the light
uniform vec3 lightIrradiance; // of a surface that faces it
uniform vec3 surroundings;    // radiance
uniform int pass;             // counts up, other random numbers each

out vec4 outColor;

void main() {
    vec2 pixel = floor(gl_FragCoord.xy);
    vec3 u = vec3(randomAt(pixel, uint(pass), 0u), randomAt(pixel, uint(pass), 1u),
                  randomAt(pixel, uint(pass), 2u));
    setPoint(eye, pixelAngle, pass);
    vec3 passes;
    float presence = materialPresence(passes);
    vec3 glow = materialEmission(point.view) * presentShare;
    materialSetup();
    MaterialEval f = materialEval(lightDirection); // with the cosine
    vec3 color = (f.diffuse + f.specular) * lightIrradiance;
    MaterialSample s = materialSample(u, randomAt(pixel, uint(pass), 3u));
    if (s.event != 0) color += s.weight * surroundings;
    outColor = vec4(color * presence + glow, presence);
}

// SPDX-License-Identifier: Apache-2.0
// Ends the fragment shader of a material on the page: a few samples of the BSDF find environment and
// lights, and a few samples of each of them; the host averages over passes. Samples of the BSDF read
// the environment where its mip level is as coarse as they are sparse (filtered importance sampling,
// Colbert and Krivanek 2007). Those of the environment and of lights are the same in all pixels, so
// that what they miss is smooth; both ways share by the power heuristic (Veach 1997).
#include "shaders/web/point.glsl"
#include "shaders/web/environment.glsl"
#include "shaders/web/random.glsl"
#include "shaders/web/lights.glsl"

uniform vec3 eye;
uniform float pixelAngle;
uniform ivec4 passInfo; // index, samples in this pass, samples in all passes, flags
uniform vec2 environmentInfo; // texels, levels
uniform sampler2D environmentSamples; // a row for each pass: direction and density, radiance
uniform vec3 environmentDensity; // level of the map that is sampled, density of a luminance of 1, trust
uniform ivec2 lightSamples; // in a pass: of the environment, of each light that has a size
const int PAGE_CLOSED = 1; // a shape with an inside: no light from behind comes through

out vec4 outColor;

// For diffuse lobes samples of lights count as if they were so much denser: all pixels share them, and
// their error is smooth. In mirrors they would be seen as highlights of their own.
const float LIGHT_TRUST = 8.0;

float heuristic(float a, float b) {
    return a * a / max(a * a + b * b, 1e-30);
}

// The share of a sample of the BSDF where light is sampled too: of diffuse lobes, and of others.
vec2 ownShare(float pdf, float density, float trust) {
    return vec2(heuristic(pdf, trust * density), heuristic(pdf, min(trust, 1.0) * density));
}

bool isBlocked(vec3 wi) {
    bool behind = (dot(wi, point.geometricNormal) > 0.0) != woOutside();
    return behind && (passInfo.w & PAGE_CLOSED) != 0;
}

// The density by solid angle with which the host draws environmentSamples.
float environmentChance(vec3 w) {
    int level = int(environmentDensity.x);
    ivec2 size = textureSize(environmentMap, level);
    ivec2 at = min(ivec2(domeTexel(worldToEnvironment * w) * vec2(size)), size - 1);
    vec3 map = texelFetch(environmentMap, max(at, ivec2(0)), level).rgb;
    return luminance(environmentScale * map + ambient) * environmentDensity.y;
}

// Light that a sample of the BSDF finds: the environment, and the lights that it meets. Diffuse and
// specular shares of the value, each over the density.
vec3 along(vec3 wi, vec3 diffuse, vec3 specular, float pdf, bool delta) {
    float apart = float(passInfo.z) * pdf * 4.0 * PI / environmentInfo.x;
    // Half as wide as the samples are apart: a filter reaches over two texels. More would blur.
    float lod = delta ? 0.0 : clamp(-0.5 * log2(max(apart, 1e-20)) - 1.0, 0.0, environmentInfo.y);
    float found = delta || lightSamples.x == 0 ? 0.0 : float(lightSamples.x) * environmentChance(wi);
    vec2 own = found > 0.0 ? ownShare(float(passInfo.y) * pdf, found, environmentDensity.z) : vec2(1.0);
    vec3 sum = (diffuse * own.x + specular * own.y) * environmentAt(wi, lod);
    if (isBlocked(wi)) return sum;
    for (int i = 0; i < lightCount; ++i) {
        Light l = lightAt(i);
        float density;
        vec3 radiance = foundLight(l, point.position, wi, density);
        if (density == 0.0) continue;
        vec2 share = vec2(1.0);
        if (!delta) share = ownShare(float(passInfo.y) * pdf, float(lightSamples.y) * density, LIGHT_TRUST);
        sum += (diffuse * l.diffuse * share.x + specular * l.specular * share.y) * radiance;
    }
    return sum;
}

void main() {
    setPoint(eye, pixelAngle, passInfo.x);
    vec2 pixel = floor(gl_FragCoord.xy);
    float glows = 1.0;
#ifdef PRESENCE
    vec3 passes;
    float presence = materialPresence(passes);
    if (randomAt(pixel, uint(passInfo.x), 7u) >= presence) discard;
    glows = presentShare / presence; // what light passes through glows, too
#endif
    vec3 color = materialEmission(point.view) * glows;
    materialSetup();
    float share = 1.0 / float(passInfo.y);
    // One loop over all samples, so that the lobes stand in the text once.
    int ofLights = lightCount * lightSamples.y, others = ofLights + lightSamples.x;
    for (int i = 0; i < others + passInfo.y; ++i) {
        MaterialSample s = materialSampleNone();
        vec2 shares = vec2(1.0); // of diffuse and of specular light
        vec3 radiance = vec3(0.0);
        float trust = LIGHT_TRUST;
        float density = 0.0;     // by solid angle, of all samples of the kind together; 0: no choice
        bool meets = true;       // samples of the BSDF may find the same light
        if (i < ofLights) {
            int number = i / lightSamples.y, k = i - number * lightSamples.y;
            uint index = uint(passInfo.x * lightSamples.y + k), d = 8u + 4u * uint(number);
            Light l = lightAt(number);
            vec2 u = vec2(randomAt(vec2(0.0), index, d), randomAt(vec2(0.0), index, d + 1u));
            radiance = sampleLight(l, point.position, u, s.wi, density);
            if (radiance == vec3(0.0) || (density == 0.0 && k > 0) || isBlocked(s.wi)) continue;
            density *= float(lightSamples.y);
            shares = vec2(l.diffuse, l.specular);
            meets = isMet(l);
        } else if (i < others) {
            int at = 2 * (i - ofLights);
            vec4 to = texelFetch(environmentSamples, ivec2(at, passInfo.x), 0);
            s.wi = to.xyz;
            density = to.w * float(lightSamples.x);
            trust = environmentDensity.z;
            radiance = texelFetch(environmentSamples, ivec2(at + 1, passInfo.x), 0).rgb;
        } else {
            uint index = uint(passInfo.x * passInfo.y + i - others);
            vec3 u = vec3(randomAt(pixel, index, 0u), randomAt(pixel, index, 1u),
                          randomAt(pixel, index, 2u));
            s = materialSample(u, randomAt(pixel, index, 3u));
            if (s.event == 0) continue;
            if ((s.event & LOBE_DELTA) != 0) {
                color += along(s.wi, s.diffuseWeight, s.specularWeight, s.pdf, true) * share;
                continue;
            }
        }
        MaterialEval f = materialEvalBut(s.wi, i < others ? -1 : drawnLobe);
        f.diffuse += s.diffuseWeight;
        f.specular += s.specularWeight;
        f.pdf += s.pdf;
        if (i >= others) {
            float inverse = f.pdf > 0.0 ? share / f.pdf : 0.0;
            color += along(s.wi, f.diffuse * inverse, f.specular * inverse, f.pdf, false);
            continue;
        }
        float found = meets ? float(passInfo.y) * f.pdf : 0.0;
        vec2 weight = vec2(1.0);
        if (density > 0.0) {
            weight = found > 0.0 ? 1.0 - ownShare(found, density, trust) : vec2(1.0);
            weight /= density;
        }
        color += (f.diffuse * shares.x * weight.x + f.specular * shares.y * weight.y) * radiance;
    }
    // A value that is no number would stay in the mean for ever.
    if (any(isnan(color)) || any(isinf(color))) color = vec3(0.0);
    outColor = vec4(color, 1.0);
}

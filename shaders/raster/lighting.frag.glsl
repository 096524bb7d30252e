// SPDX-License-Identifier: Apache-2.0
// Direct light: one sample of each light with a shadow map, and samples of the BSDF for what lights
// would miss. Both find the same light, so their shares follow the power heuristic (Veach 1997).
// The shadows of the BSDF's samples are approximate, hence the lights' weigh more than their density
// says.
#include "shaders/raster/links.glsl"
#include "shaders/raster/shadows.glsl"
#include "shaders/raster/glow.glsl"
layout(location = 0) out vec4 outColor;
// The data that a preview is smoothed by, see smoothPreview.frag.glsl.
layout(location = 1) out vec4 outNoisy;  // light that neighbours find by other samples
layout(location = 2) out vec4 outGuide;  // how light the material is; w: prim, 0 where nothing is smoothed
layout(location = 3) out vec4 outPlace;
layout(location = 4) out vec4 outNormal;

#ifdef MATERIAL_IS_FIBRE
const float lightTrust = 3.0; // what light through a fibre makes of few directions is noisier than its shadows are wrong
#else
const float lightTrust = 8.0;
#endif

// Less than the cells of the sky's maps are wide; as RasterLights has it. 1 - cosine of half the angle.
const float NARROW_SUN = 0.003;

// Of previews: noise is better than what all pixels have wrong alike.
bool isPreview() {
    return sharedEvery > 1;
}
float trustOf(int kind) {
    return isPreview() && (kind == LIGHT_DOME || kind == LIGHT_MORE_DOME) ? 1.0 : lightTrust;
}

// That each pixel takes of a light.
float samplesOf(Light l) {
    int kind = l.kind;
    bool sky = PATINA_LIGHT_SKY(kind == LIGHT_DOME || kind == LIGHT_MORE_DOME);
    return l.perPixel > 0.0 ? l.perPixel : sky ? l.domeSamples : 1.0;
}

float heuristic(float a, float b) {
    return a * a / max(a * a + b * b, 1e-30);
}

bool isLit(Light l) {
    return isLinked(vIds.z, l.category);
}

// The dominant light of a dome, which is apart from its harmonics only.
bool isSunOfDome(Light l) {
    return (l.flags & LIGHT_OF_DOME) != 0;
}

#ifdef MANY_LIGHTS
#include "shaders/raster/manyLights.glsl"
#endif
#include "shaders/raster/refraction.glsl"

// Of the side that is seen; zero where light also comes from behind.
vec3 facingNormal() {
#if defined(MATERIAL_TRANSMITS) || defined(MATERIAL_IS_FIBRE)
    return vec3(0.0);
#else
    return dot(point.normal, point.view) < 0.0 ? -point.normal : point.normal;
#endif
}

bool outlines = false;    // lights that are their outline go another way, see areaLights.glsl
bool lightsAlone = false; // no sample of the BSDF finds the same light

vec3 guide = vec3(0.0);

// Light from one light's sample. guides: no light, but the material's own guide.
vec3 fromLight(Light l, bool guides) {
    int kind = l.kind;
#ifdef DOME_METHOD
    if ((kind == LIGHT_DOME || kind == LIGHT_MORE_DOME) && !guides) return vec3(0.0); // see skyLight()
#endif
    vec3 wi;
    float density, reach;
    vec3 radiance = lightSample(l, point.position, wi, density, reach);
    if (guides) wi = reflect(-point.view, point.normal);
    else if (radiance == vec3(0.0)) return vec3(0.0);
    MaterialEval f = materialEval(wi);
    if (guides) {
        guide = f.diffuse * (PI / max(abs(dot(point.normal, wi)), 0.05)) + f.specular / max(f.pdf, 1e-3);
        return vec3(0.0);
    }
#ifdef MATERIAL_TRANSMITS
    // Samples of the BSDF find what comes through the object.
    if ((dot(wi, point.geometricNormal) > 0.0) != woOutside()) f.specular = vec3(0.0);
#endif
    vec3 value = f.diffuse * l.diffuse + f.specular * l.specular;
    if (value == vec3(0.0)) return vec3(0.0);
    float weight = 1.0;
    if (!isDelta(l)) {
        // Weights of domes come from the density's table on both sides.
        bool sky = PATINA_LIGHT_SKY(kind == LIGHT_DOME || kind == LIGHT_MORE_DOME);
        float chance = samplesOf(l) * (sky ? domePdf(l, wi, 0.0) : density);
        bool found = kind != LIGHT_TRIANGLE && bsdfSamples > 0 && !lightsAlone;
        weight = (found ? heuristic(trustOf(kind) * chance, float(bsdfSamples) * f.pdf) : 1.0) / density;
    }
    return value * radiance * weight * shadowAt(l, wi);
}

#ifdef AREA_OUTLINES
#include "shaders/raster/areaLights.glsl"
#else
bool isOutline(Light l) {
    return false;
}
#endif

// Light that a sample of the BSDF finds.
vec3 along(MaterialSample s) {
#ifdef MATERIAL_TRANSMITS
    if ((s.event & LOBE_TRANSMIT) != 0 && !s.diffuse) return throughObject(s);
#endif
    vec3 sum = vec3(0.0);
    bool delta = (s.event & LOBE_DELTA) != 0;
    float pdf = float(bsdfSamples) * s.pdf;
    float sky = -1.0;
#ifdef MANY_LIGHTS
    int at = 0;
    while (true) {
        float share;
        int i = nextAlong(at, delta || s.pdf > NARROW, point.position, s.wi, share);
        if (i < 0) break;
#else
    const float share = 1.0;
    for (int i = 0; i < lightsFound; ++i) {
#endif
        Light l = lights[i];
        int kind = l.kind;
        if (isDelta(l) || kind > LIGHT_DOME || !isLit(l) || (outlines && isOutline(l))) continue;
        vec3 radiance;
        float density, seen = 1.0;
        if (PATINA_LIGHT_SKY(kind == LIGHT_DOME)) {
#ifdef DOME_METHOD
            continue; // see skyLight()
#endif
            float texel = 4.0 * PI / max(domeTexels, 1.0);
            float sharper = isPreview() ? 256.0 : passesTaken;
            float lod = delta ? 0.0 : 0.5 * log2(1.0 / max(pdf * sharper * texel, 1e-20));
            lod = clamp(lod, 0.0, float(domeLevel));
            density = samplesOf(l) * domePdf(l, s.wi, lod);
            radiance = radianceOfDome(l, s.wi, lod) * filterFactor(l, point.position, s.wi, LIGHT_FAR);
        } else {
            float t;
            if (!lightAlong(l, point.position, s.wi, t, density, radiance)) continue;
            radiance *= filterFactor(l, point.position, s.wi, t);
            density *= samplesOf(l);
        }
        vec3 shadow = vec3(1.0);
        if (l.firstMap >= 0) {
            if (PATINA_LIGHT_SKY(kind == LIGHT_DOME || (kind == LIGHT_DISTANT && l.versine > NARROW_SUN))) {
                if (sky < 0.0) sky = skyReaches(s.wi);
                shadow = mix(l.shadowColor, vec3(1.0), sky);
            } else {
                // The light's own sample tells how much of it the point sees.
                vec3 there = l.sampled;
                shadow = shadowByMaps(l, isAtPlace(l) ? normalize(there - point.position) : there);
            }
        }
        float weight = share * l.weight * (delta ? 1.0 : heuristic(pdf, trustOf(kind) * density));
        sum += (s.diffuseWeight * l.diffuse + s.specularWeight * l.specular) * radiance *
               shadow * weight;
    }
    return sum;
}

#ifdef DOME_METHOD
#include "shaders/raster/sky.glsl"
#endif

void main() {
    outNoisy = outGuide = outPlace = outNormal = vec4(0.0);
    setPointFromCamera();
#ifdef MATERIAL_IS_VOLUME
    vec4 fog = fogHere();
    outColor = vec4(fog.rgb * exposure, fog.a);
    return;
#endif
#ifdef PRESENCE
    if (!isPresent()) discard;
#endif
    vec3 color = glow();
    if (meshLight.w == 3.0) {
        outColor = vec4(color * exposure, 1.0);
        return;
    }
    materialSetup();
#ifdef AREA_OUTLINES
    outlines = isTransformable();
#endif
    // Neighbours take other samples of what is between firstShared and lightsTaken.
    int turn = (int(gl_FragCoord.x) + 3 * int(gl_FragCoord.y) + passIndex) % sharedEvery;
    int every = isPreview() ? 1 : 0, own = (lightsTaken - firstShared) / sharedEvery;
#ifdef MANY_LIGHTS
    own = lightsChosen;
    vec2 inCells = randomAt(uvec2(gl_FragCoord.xy), uint(passIndex), 50u);
    beginChoice(point.position, facingNormal(), vec4(inCells, randomAt(uvec2(gl_FragCoord.xy), uint(passIndex), 51u)));
#endif
    vec3 noisy = vec3(0.0);
    for (int k = firstSampled - every; k < firstShared + own; ++k) {
        bool pooled = k >= firstShared, guides = k < firstSampled;
        float share = pooled ? float(sharedEvery) : 1.0;
#ifdef MANY_LIGHTS
        int i = pooled ? nextChosen(share) : max(k, 0);
        if (i < 0) break;
#else
        int i = pooled ? firstShared + turn + (k - firstShared) * sharedEvery : max(k, 0);
#endif
        Light l = lights[i];
        if (!guides && (!isLit(l) || isSunOfDome(l))) continue;
        vec3 light;
#ifdef AREA_OUTLINES
        if (outlines && isOutline(l) && !guides)
            light = byOutline(l) + onSheen(l);
        else
#endif
            light = fromLight(l, guides);
        noisy += pooled ? share * light : vec3(0.0);
        color += pooled ? vec3(0.0) : light;
    }
    for (int i = 0; i < bsdfSamples; ++i) {
        uvec2 pixel = uvec2(gl_FragCoord.xy);
        uint index = uint(passIndex * bsdfSamples + i);
        vec2 choice = randomAt(pixel, index, 1u);
        MaterialSample s = materialSample(vec3(randomAt(pixel, index, 0u), choice.x), choice.y);
        if (s.event == 0) continue;
        vec3 found = along(s) / float(bsdfSamples);
        // Reflections of narrow lobes are as sharp as they should be.
        float sharp = (s.event & LOBE_DELTA) != 0 ? 1.0 : smoothstep(1.0, 6.0, s.pdf);
        color += found * sharp;
        noisy += found * (1.0 - sharp);
    }
#ifdef DOME_METHOD
    color += skyLight();
#endif
    color += noisy;
#ifndef MATERIAL_TRANSMITS
    if (isPreview()) {
        outNoisy = vec4(noisy * exposure, 0.0);
        outGuide = vec4(guide, float(drawInfo.y + 1));
        outPlace = vec4(point.position, 1.0);
        outNormal = vec4(isTube() ? vec3(0.0) : point.normal, 0.0);
    }
#endif
    outColor = vec4(color * exposure, 1.0);
}

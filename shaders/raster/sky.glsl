// SPDX-License-Identifier: Apache-2.0
// Domes by other methods than samples with shadow maps (choice point domeLight). Passes are free of
// noise but for shadows.
layout(binding = 20) uniform sampler2DArray prefilteredMaps;

const int DOME_FILTERED = 1;
const int DOME_PREFILTERED = 2;
const int DOME_HARMONICS = 3;
const int PREFILTERED_LEVELS = 5; // of PrefilteredSky

// Domes and their suns come before the lights that pixels choose among.
int endOfDomes(int end) {
#ifdef MANY_LIGHTS
    return min(end, firstShared);
#else
    return end;
#endif
}

// Only lobes of some kinds are left in the material; bits are those of LOBE_*.
void keepLobes(int kinds) {
    float sum = 0.0;
    for (int i = 0; i < LOBES; ++i) {
        bool kept = (kinds & (1 << lobeKind(i))) != 0;
        if (!kept) lobeWeight[i] = vec3(0.0);
        if (!kept) lobeChance[i] = 0.0;
        sum += lobeChance[i];
    }
    for (int i = 0; i < LOBES; ++i)
        lobeChance[i] /= sum > 0.0 ? sum : 1.0;
}

// Irradiance of a dome by its harmonics; see SkyHarmonics.
vec3 domeIrradiance(Light l, vec3 normal) {
    if (l.firstHarmonic < 0) return PI * l.domeRadiance;
    vec3 n = toDome(l, normal);
    float h[9] = float[9](0.282094792, 0.488602512 * n.y, 0.488602512 * n.z, 0.488602512 * n.x,
                          1.092548431 * n.x * n.y, 1.092548431 * n.y * n.z,
                          0.315391565 * (3.0 * n.z * n.z - 1.0), 1.092548431 * n.x * n.z,
                          0.546274215 * (n.x * n.x - n.y * n.y));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 9; ++i)
        sum += h[i] * lightTables[l.firstHarmonic + i].xyz;
    return l.domeRadiance * max(sum, vec3(0.0));
}

vec3 prefiltered(Light l, vec3 wi, float alpha) {
    if (l.domeLayer < 0.0) return l.domeRadiance;
    vec2 at = domeTexel(toDome(l, wi));
    // Below the first level the image itself gets sharper, by its own smaller versions.
    vec3 sharp = textureLod(domeMaps, vec3(at, l.domeLayer), max(0.0, log2(max(alpha * alpha * sqrt(domeTexels), 1e-6)))).rgb;
    if (alpha <= 0.02) return l.domeRadiance * sharp;
    float level = alpha < 0.2   ? (alpha - 0.1) / 0.1
                  : alpha < 0.4 ? 1.0 + (alpha - 0.2) / 0.2
                  : alpha < 0.7 ? 2.0 + (alpha - 0.4) / 0.3
                                : min(3.0 + (alpha - 0.7) / 0.3, 4.0);
    float low = floor(max(level, 0.0)), first = l.domeLayer * float(PREFILTERED_LEVELS);
    vec3 a = textureLod(prefilteredMaps, vec3(at, first + low), 0.0).rgb;
    vec3 b = textureLod(prefilteredMaps, vec3(at, first + min(low + 1.0, 4.0)), 0.0).rgb;
    vec3 rough = mix(a, b, max(level, 0.0) - low);
    return l.domeRadiance * mix(sharp, rough, clamp((alpha - 0.02) / 0.08, 0.0, 1.0));
}

// How much of the sky a surface sees: the mean over directions by the cosine, all pixels the same.
float skyShare(vec3 normal) {
    if (skySide == 0) return 1.0;
    vec3 x = anyTangent(normal), y = cross(normal, x);
    float sum = 0.0;
    const int count = 16;
    for (int i = 0; i < count; ++i) {
        vec2 u = randomAt(uvec2(0u), uint(passIndex * count + i), 5u);
        float r = sqrt(u.x), phi = TWO_PI * u.y;
        sum += skyReaches(x * (r * cos(phi)) + y * (r * sin(phi)) + normal * sqrt(1.0 - u.x));
    }
    return sum / float(count);
}

// Diffuse and sheen by harmonics, and mirrors by prefiltered maps where the method has them.
vec3 skyByLobes(bool mirrors) {
    vec3 sum = vec3(0.0);
    float share = -1.0;
    for (int i = 0; i < LOBES; ++i) {
        int kind = lobeKind(i);
        if (lobeWeight[i] == vec3(0.0) || kind == LOBE_OTHER || (kind == LOBE_MIRROR && !mirrors)) continue;
        Frame f = lobeFrame(i);
        vec3 normal = f.wo.z < 0.0 ? -f.normal : f.normal;
        vec3 mirrored = reflect(-point.view, normal);
        float seen;
        if (kind == LOBE_MIRROR) {
            seen = skyReaches(mirrored);
        } else {
            if (share < 0.0) share = skyShare(normal);
            seen = share;
        }
        for (int k = 0; k < endOfDomes(lightsFound); ++k) {
            Light l = lights[k];
            if (l.kind != LIGHT_DOME || !isLit(l)) continue;
            vec3 light = kind == LOBE_MIRROR ? prefiltered(l, mirrored, lobeAlpha(i))
                                             : INV_PI * domeIrradiance(l, normal);
            vec3 shadow = l.firstMap < 0 ? vec3(1.0) : mix(l.shadowColor, vec3(1.0), seen);
            sum += lobeWeight[i] * lobeAlbedo[i] * light * shadow * l.weight *
                   (kind == LOBE_DIFFUSE ? l.diffuse : l.specular);
        }
    }
    return sum;
}

// Samples of the material look into the maps, each into as small a version as it is alone.
vec3 skyBySamples() {
    int count = filteredSamples;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        uint index = uint(passIndex * count + i);
        vec2 choice = randomAt(uvec2(0u), index, 1u);
        MaterialSample s = materialSample(vec3(randomAt(uvec2(0u), index, 0u), choice.x), choice.y);
        if (s.event == 0) continue;
        float texel = 4.0 * PI / max(domeTexels, 1.0);
        bool delta = (s.event & LOBE_DELTA) != 0;
        float lod = delta ? 0.0 : 0.5 * log2(1.0 / max(s.pdf * float(count) * texel, 1e-20));
        float sky = -1.0;
        for (int k = 0; k < endOfDomes(lightsFound); ++k) {
            Light l = lights[k];
            if (l.kind != LIGHT_DOME || !isLit(l)) continue;
            vec3 light = radianceOfDome(l, s.wi, clamp(lod, 0.0, float(domeLevel))) *
                         filterFactor(l, point.position, s.wi, LIGHT_FAR);
            if (sky < 0.0) sky = skyReaches(s.wi);
            vec3 shadow = l.firstMap < 0 ? vec3(1.0) : mix(l.shadowColor, vec3(1.0), sky);
            sum += (s.diffuseWeight * l.diffuse + s.specularWeight * l.specular) * light * shadow * l.weight;
        }
    }
    return sum / float(max(count, 1));
}

// All light of domes by the method in force. Leaves fewer lobes in the material.
vec3 skyLight() {
    int rest = 15;
    vec3 sum = vec3(0.0);
    if (DOME_METHOD != DOME_FILTERED) {
        bool mirrors = DOME_METHOD == DOME_PREFILTERED;
        rest = mirrors ? 1 << LOBE_OTHER : (1 << LOBE_OTHER) | (1 << LOBE_MIRROR);
        sum = skyByLobes(mirrors);
        vec3 weights[max(LOBES, 1)];
        float chances[max(LOBES, 1)];
        for (int i = 0; i < LOBES; ++i) {
            weights[i] = lobeWeight[i];
            chances[i] = lobeChance[i];
        }
        keepLobes((1 << LOBE_DIFFUSE) | (1 << LOBE_SHEEN));
        for (int k = firstSampled; k < endOfDomes(lightsTaken); ++k)
            if (isSunOfDome(lights[k]) && isLit(lights[k])) sum += fromLight(lights[k], false);
        for (int i = 0; i < LOBES; ++i) {
            lobeWeight[i] = weights[i];
            lobeChance[i] = chances[i];
        }
    }
    keepLobes(rest);
    bool left = false;
    for (int i = 0; i < LOBES; ++i)
        left = left || lobeChance[i] > 0.0;
    return left ? sum + skyBySamples() : sum;
}

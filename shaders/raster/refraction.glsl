// SPDX-License-Identifier: Apache-2.0
// The scene behind surfaces that transmit, and the media inside. An approximation: light goes through
// the near face, straight to the nearest face that is turned away, and out there; then it meets what
// the screen shows of all other surfaces, else lights and domes. (Wyman 2005, "An approximate
// image-space approach for interactive refraction", with samples of the BSDF in place of the
// direction.) Light between two such objects, and what the screen does not show, is not seen.
#ifdef MATERIAL_TRANSMITS
layout(binding = 21) uniform sampler2D sceneColor;
layout(binding = 22) uniform sampler2D sceneDepth;
layout(binding = 23) uniform sampler2D backPosition; // w: 1 there is such a face
layout(binding = 24) uniform sampler2D backNormal;   // out of the object

// Window coordinates; z is negative where a point is behind the camera or off the screen, and 1 beyond
// the far plane, which is close behind the scene.
vec3 onScreen(vec3 p) {
    vec4 clip = worldToClip * vec4(p, 1.0);
    if (clip.w <= 0.0) return vec3(-1.0);
    vec3 q = clip.xyz / clip.w * 0.5 + 0.5;
    bool shown = q.z >= 0.0 && all(greaterThanEqual(q.xy, vec2(0.0))) && all(lessThan(q.xy, vec2(1.0)));
    return shown ? vec3(q.xy, min(q.z, 1.0)) : vec3(-1.0);
}

// Steps along a ray until it is behind what the screen shows there.
bool seenAlong(vec3 origin, vec3 direction, out vec3 color) {
    const int steps = 24;
    float before = 0.0;
    for (int i = 1; i <= steps; ++i) {
        float f = float(i) / float(steps);
        float t = sceneExtent * f * f;
        vec3 q = onScreen(origin + direction * t);
        if (q.z < 0.0) return false;
        float depth = textureLod(sceneDepth, q.xy, 0.0).x;
        if (depth < 1.0 && q.z > depth) {
            for (int k = 0; k < 6; ++k) {
                float middle = 0.5 * (before + t);
                vec3 m = onScreen(origin + direction * middle);
                if (m.z > textureLod(sceneDepth, m.xy, 0.0).x)
                    t = middle;
                else
                    before = middle;
            }
            q = onScreen(origin + direction * t);
            color = textureLod(sceneColor, q.xy, 0.0).rgb / max(exposure, 1e-20);
            return true;
        }
        before = t;
    }
    return false;
}

// Distance to the far side of the object that a ray at the shaded point is in, and its normal.
bool exitOf(vec3 p, vec3 direction, out float t, out vec3 n) {
    t = 0.0;
    n = direction;
    vec3 q = onScreen(p);
    if (q.z < 0.0) return false;
    vec4 back = textureLod(backPosition, q.xy, 0.0);
    if (back.w == 0.0) return false;
    n = textureLod(backNormal, q.xy, 0.0).xyz;
    t = length(back.xyz - p);
    // Once more, where a ray of that length comes to.
    q = onScreen(p + direction * t);
    if (q.z >= 0.0) {
        vec4 nearer = textureLod(backPosition, q.xy, 0.0);
        if (nearer.w != 0.0) {
            back = nearer;
            n = textureLod(backNormal, q.xy, 0.0).xyz;
        }
    }
    float c = dot(n, direction);
    float straight = length(back.xyz - p);
    t = c > 0.05 ? clamp(dot(back.xyz - p, n) / c, 0.0, 2.0 * straight) : straight;
    return true;
}

// Light of all lights along a ray that meets no surface.
vec3 lightsAlong(vec3 origin, vec3 direction, float pdf, bool delta) {
    vec3 sum = vec3(0.0);
    float texel = 4.0 * PI / max(domeTexels, 1.0);
    float lod = delta ? 0.0 : 0.5 * log2(1.0 / max(float(bsdfSamples) * pdf * passesTaken * texel, 1e-20));
#ifdef MANY_LIGHTS
    int at = 0;
    while (true) {
        float share;
        int i = nextAlong(at, delta || pdf > NARROW, origin, direction, share);
        if (i < 0) break;
#else
    const float share = 1.0;
    for (int i = 0; i < lightsFound; ++i) {
#endif
        Light l = lights[i];
        int kind = l.kind;
        if (isDelta(l) || kind > LIGHT_DOME || !isLit(l)) continue;
        vec3 radiance;
        if (PATINA_LIGHT_SKY(kind == LIGHT_DOME)) {
            radiance = radianceOfDome(l, direction, clamp(lod, 0.0, float(domeLevel))) *
                       filterFactor(l, origin, direction, LIGHT_FAR);
        } else {
            float t, density;
            if (!lightAlong(l, origin, direction, t, density, radiance)) continue;
            radiance *= filterFactor(l, origin, direction, t);
        }
        sum += radiance * (share * l.weight) * l.specular;
    }
    return sum;
}

#ifdef MATERIAL_HAS_INTERIOR
// Light after a distance through the medium: light from behind, light that the medium emits, and light
// scattered once. The last is not weakened on its way in. In even light a white medium then loses nothing, as
// if all orders of scattering were counted.
vec3 throughMedium(vec3 behind, vec3 start, vec3 direction, float distance, bool boundary,
                   out vec3 transmittance) {
    Medium m = materialMedium();
    vec3 scattering = mediumScattering(m);
    vec3 sigma = m.absorption + scattering;
    transmittance = exp(-sigma * distance);
    vec3 stretch = mix((1.0 - transmittance) / max(sigma, vec3(1e-20)), vec3(distance),
                       lessThan(sigma * distance, vec3(1e-4)));
    vec3 sum = behind * transmittance + m.emission * stretch;
    if (largest(scattering) <= 0.0) return sum;
    float mean = largest(sigma) > 0.0 ? min(1.0 / largest(sigma), 0.5 * distance) : 0.0;
    PhaseMixture phase = phaseMixture(m, vec3(1.0));
    vec3 found = vec3(0.0);
    int end = lightsTaken;
#ifdef MANY_LIGHTS
    int cell = listCell;
    end = firstShared + lightsChosen;
    vec2 inCells = randomAt(uvec2(gl_FragCoord.xy), uint(passIndex), 52u);
    beginChoice(start + direction * mean, vec3(0.0), vec4(inCells, randomAt(uvec2(gl_FragCoord.xy), uint(passIndex), 53u)));
#endif
    for (int k = firstSampled; k < end; ++k) {
        float share = 1.0;
#ifdef MANY_LIGHTS
        int i = k < firstShared ? k : nextChosen(share);
        if (i < 0) break;
#else
        int i = k;
#endif
        Light l = lights[i];
        if (!isLit(l) || isSunOfDome(l)) continue;
        if (PATINA_LIGHT_SKY(l.kind == LIGHT_DOME && l.domeSamples == 0.0)) { // nobody samples it: its mean
            found += radianceOfDome(l, direction, max(float(domeLevel) - 1.0, 0.0)) * l.weight *
                     l.specular * filterFactor(l, start + direction * mean, direction, LIGHT_FAR);
            continue;
        }
        vec3 wi;
        float density, reach;
        vec3 radiance = lightSample(l, start + direction * mean, wi, density, reach) / density;
        vec3 p = phaseMixtureEval(phase, -direction, wi).value;
        // The object's own far side is in the shadow maps, so they tell nothing of light from there.
        bool outwards = dot(wi, point.geometricNormal) > 0.0;
        found += radiance * p * l.specular * (boundary && !outwards ? vec3(1.0) : shadowAt(l, wi)) * share;
    }
#ifdef MANY_LIGHTS
    listCell = cell;
#endif
    return sum + scattering * stretch * found;
}
#endif

// Light that a sample finds which goes through the surface.
vec3 throughObject(MaterialSample s) {
    bool delta = (s.event & LOBE_DELTA) != 0;
    vec3 p = point.position, d = s.wi, n;
    float t = 0.0;
    bool goes = woOutside() && !MATERIAL_IS_THIN && exitOf(p, d, t, n);
    vec3 q = p + d * t;
    if (goes && dot(d, n) > 0.0) {
        vec3 bent = refract(d, -n, 1.0 / max(s.eta, 1e-3));
        d = dot(bent, bent) > 0.0 ? bent : reflect(d, n);
    }
    vec3 behind;
    if (!seenAlong(q + d * (1e-3 * t), d, behind)) behind = lightsAlong(q, d, s.pdf, delta);
#ifdef MATERIAL_HAS_INTERIOR
    vec3 transmittance;
    if (goes) behind = throughMedium(behind, p, s.wi, t, true, transmittance);
#endif
    return s.specularWeight * behind;
}

#ifdef MATERIAL_IS_VOLUME
// A boundary that bends nothing, around a medium.
vec4 fogHere() {
    vec3 d = -point.view;
    bool enters = dot(point.geometricNormal, point.view) >= 0.0;
    vec3 start = enters || isPerspective == 0 ? point.position : eye, n;
    float t = length(point.position - start);
    if (enters && !exitOf(start, d, t, n)) t = 0.0;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(sceneDepth, pixel, 0).x;
    if (depth < 1.0) {
        vec3 at = vec3(gl_FragCoord.xy / vec2(textureSize(sceneDepth, 0)), depth);
        vec4 world = clipToWorld * vec4(at * 2.0 - 1.0, 1.0);
        t = min(t, length(world.xyz / world.w - start));
    }
    vec4 behind = texelFetch(sceneColor, pixel, 0);
    vec3 transmittance;
    vec3 color = throughMedium(behind.rgb / max(exposure, 1e-20), start, d, t, false, transmittance);
    return vec4(color, mix(1.0, behind.a, luminance(transmittance)));
}
#endif
#endif

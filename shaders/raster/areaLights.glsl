// SPDX-License-Identifier: Apache-2.0
// Area lights by linearly transformed cosines (choice point areaLight): no noise but that of shadows.
// Shadows are the share of the lights' samples above the surface's horizon that are seen, all of them
// alike. Diffuse lobes count as Lambert's, mirrors as round GGX with the albedo of the view; sheen has
// the lights' samples.
#include "shaders/lib/ltcFit.glsl"
#include "shaders/lib/ltc.glsl"

// Whether the light is even over its whole surface, so that its outline says all.
bool isOutline(Light l) {
    return !isDelta(l) && l.kind < LTC_SHAPES && l.firstValue < 0 &&
           l.firstProfile < 0 && l.focus == 0.0 && !hasCone(l) && l.flags >> LIGHT_FILTERS_SHIFT == 0;
}

// Whether lobes of the material are all of kinds that transforms stand for. In what is nearly a mirror
// the corners of the outlines would show, and samples make little noise.
bool isTransformable() {
    for (int i = 0; i < LOBES; ++i) {
        int kind = lobeKind(i);
        if (lobeWeight[i] == vec3(0.0)) continue;
        if (kind == LOBE_OTHER) return false;
        if (kind == LOBE_MIRROR && (!lobeIsRound(i) || lobeAlpha(i) < 0.01)) return false;
    }
    return true;
}

// The outline as the point sees it. @returns how many corners, 0 where it shines away
int outlineOf(Light l, out vec3 corners[LTC_CORNERS]) {
    int kind = l.kind;
    vec3 d = point.position - l.origin;
    if ((kind == SHAPE_RECT || kind == SHAPE_DISK) && dot(l.normal, d) <= 0.0) return 0;
    LtcOutline outline = ltcOutline(kind, toShape(l, d));
    for (int i = 0; i < outline.count; ++i)
        corners[i] = fromShape(l, outline.corners[i]) - d;
    return outline.count;
}

// Share of the light's samples that are above the plane of the surface.
float shareAbove(Light l, vec3 n) {
    int kind = l.kind;
    float h = dot(n, l.origin - point.position);
    vec3 reach = vec3(dot(n, l.axis0), dot(n, l.axis1), dot(n, l.axis2));
    if (kind == SHAPE_DISK || kind == SHAPE_SPHERE) { // a sphere's samples have a disk's shadow
        float across = kind == SHAPE_DISK ? length(reach.xy) : length(reach);
        float t = clamp(h / max(across, 1e-20), -1.0, 1.0);
        return 1.0 - (acos(t) - t * sqrt(1.0 - t * t)) * INV_PI;
    }
    // Lines along the shape, each cut exactly.
    const int lines = 8;
    bool round = kind == SHAPE_CYLINDER;
    float width = max(round ? length(reach.yz) : abs(reach.y), 1e-20), sum = 0.0;
    for (int i = 0; i < lines; ++i) {
        float t = (h + reach.x * ((float(i) + 0.5) / float(lines) - 0.5)) / width;
        sum += round ? 1.0 - acos(clamp(t, -1.0, 1.0)) * INV_PI : clamp(0.5 + t, 0.0, 1.0);
    }
    return sum / float(lines);
}

// Light of one light on all diffuse lobes and mirrors.
vec3 byOutline(Light l) {
    vec3 corners[LTC_CORNERS], own[LTC_CORNERS];
    int count = outlineOf(l, corners);
    if (count == 0) return vec3(0.0);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LOBES; ++i) {
        int kind = lobeKind(i);
        if (lobeWeight[i] == vec3(0.0) || (kind != LOBE_DIFFUSE && kind != LOBE_MIRROR)) continue;
        Frame f = lobeFrame(i);
        float side = f.wo.z < 0.0 ? -1.0 : 1.0;
        vec3 wo = vec3(f.wo.xy, side * f.wo.z);
        for (int k = 0; k < count; ++k) {
            vec3 v = toLocal(f, corners[k]);
            own[k] = ltcTurned(vec3(v.xy, side * v.z), wo);
        }
        bool mirror = kind == LOBE_MIRROR;
        vec4 map = mirror ? ltcMicrofacets(wo, lobeAlpha(i)) : vec4(1.0, 0.0, 1.0, 0.0);
        sum += lobeWeight[i] * lobeAlbedo[i] * ltcShare(own, count, map) *
               (mirror ? l.specular : l.diffuse);
    }
    if (sum == vec3(0.0) || l.firstMap < 0) return sum * l.radiance * l.weight;
    // The outline is cut at the horizon: samples below it are no shadow.
    vec3 n = dot(point.geometricNormal, point.view) < 0.0 ? -point.geometricNormal : point.geometricNormal;
    vec3 wi = unitOr(l.sampled - point.position, n);
    float above = shareAbove(l, n);
    if (dot(n, wi) <= 0.0 || above <= 1e-4) return vec3(0.0);
    return sum * l.radiance * l.weight * shadowAt(l, wi) / above;
}

// Light that sheen reflects, by its samples alone.
vec3 onSheen(Light l) {
    vec3 weights[max(LOBES, 1)];
    bool any = false;
    for (int i = 0; i < LOBES; ++i) {
        weights[i] = lobeWeight[i];
        if (lobeKind(i) != LOBE_SHEEN) lobeWeight[i] = vec3(0.0);
        any = any || lobeWeight[i] != vec3(0.0);
    }
    lightsAlone = true;
    vec3 found = any ? fromLight(l, false) : vec3(0.0);
    lightsAlone = false;
    for (int i = 0; i < LOBES; ++i)
        lobeWeight[i] = weights[i];
    return found;
}

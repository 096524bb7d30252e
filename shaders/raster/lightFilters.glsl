// SPDX-License-Identifier: Apache-2.0
// Light filters as lightTables has them: FILTER_ROWS rows each, see hdDelegate/raster/lights/rasterLightFilters.cpp.
#include "shaders/lights/filters/rows.glsl"
#include "shaders/lights/filters/box.glsl"
#include "shaders/lights/filters/opening.glsl"
#include "shaders/lights/filters/ramp.glsl"
#include "shaders/lights/filters/image.glsl"
#include "shaders/lights/filters/strength.glsl"

// A curve's knots: values, w: places.
vec3 filterCurve(int first, int count, int kind, float x) {
    int above = 0;
    for (int beyond = count; above < beyond;) { // knots before it are at x or below; the places ascend
        int middle = (above + beyond) / 2;
        if (lightTables[first + middle].w <= x)
            above = middle + 1;
        else
            beyond = middle;
    }
    if (above == 0) return lightTables[first].xyz;
    int low = first + above - 1, last = first + count - 1;
    if (above == count) return lightTables[last].xyz;
    vec4 a = lightTables[low], b = lightTables[low + 1];
    vec4 w = curveWeights(kind, (x - a.w) / (b.w - a.w));
    return w.x * lightTables[max(low - 1, first)].xyz + w.y * a.xyz + w.z * b.xyz +
           w.w * lightTables[min(low + 2, last)].xyz;
}

// at: of the filter in lightTables; wi: to the light; reach: how far it is, LIGHT_FAR at infinity
vec3 oneFilter(int at, vec3 point, vec3 wi, float reach) {
    vec4 head = lightTables[at], b0 = lightTables[at + 4], b1 = lightTables[at + 5], b2 = lightTables[at + 6],
         b3 = lightTables[at + 7];
    int type = int(head.x), flags = int(head.y);
    float density = head.z, intensity = head.w;
    bool invert = (flags & FILTER_INVERT) != 0;
    if (type == FILTER_MULTIPLIER) return vec3(1.0 + density * (intensity - 1.0));
    mat4 toFilter = transpose(mat4(lightTables[at + 1], lightTables[at + 2], lightTables[at + 3], vec4(0.0, 0.0, 0.0, 1.0)));
    vec3 p = (toFilter * vec4(point, 1.0)).xyz, value;
    FilterBox box = FilterBox(b0.xyz, b1.xyz, b2.xyz, b3.xyz, b0.w);
    if (type == FILTER_ROD) return vec3(rodStrength(filterBoxCover(box, p), invert, density, intensity));
    if (type == FILTER_RAMP) {
        float x = rampPlace(int(b0.x), p, reach, b0.y, b0.z);
        value = filterCurve(int(b1.x), int(b1.y), int(b1.z), x) * filterCurve(int(b2.x), int(b2.y), int(b2.z), x);
        return filterStrength(value, invert, density, intensity);
    }
    vec3 toLight = mat3(toFilter) * wi, crossed;
    float far = reach;
    if (reach < LIGHT_FAR) {
        toLight *= reach;
        far = 1.0;
    }
    if ((flags & FILTER_ANALYTIC) != 0) {
        bool directional = (flags & FILTER_DIRECTIONAL) != 0;
        toLight = openingAnalytic(p, directional, vec2(b2.w, b3.w), b1.w);
        far = directional ? LIGHT_FAR : 1.0;
    }
    bool crosses = openingCrossed(p, toLight, far, crossed);
    if (type == FILTER_BARN) {
        if (!crosses) return vec3(1.0);
        value = vec3(filterBoxCover(box, crossed));
    } else {
        FilterImage m = FilterImage(b0.xy, b0.zw, int(b2.x), int(b2.y), int(b2.z));
        TableCell c;
        if (!crosses && m.wrap != IMAGE_OFF) return vec3(1.0);
        value = b1.xyz;
        if (crosses && filterTexels(m, crossed, c)) value = lightTableAt(int(b3.x), c);
    }
    return filterStrength(value, invert, density, intensity);
}

// All filters from a place in lightTables on; -1: none.
vec3 filtersAt(int first, vec3 point, vec3 wi, float reach) {
    vec3 product = vec3(1.0);
    bool more = first >= 0;
    for (int at = first; more; at += FILTER_ROWS) {
        product *= oneFilter(at, point, wi, reach);
        more = (int(lightTables[at].y) & FILTER_MORE) != 0;
    }
    return product;
}

// What filters leave of a light on its way to a point.
vec3 filterFactor(Light l, vec3 point, vec3 wi, float reach) {
    return filtersAt((l.flags >> LIGHT_FILTERS_SHIFT) - 1, point, wi, reach);
}
// The same towards the camera, for a place on the light.
vec3 filtersToCamera(int first, vec3 place, vec3 wi) {
    vec3 from = isPerspective != 0 ? eye : place - forward * dot(place - eye, forward);
    return filtersAt(first, from, wi, length(place - from));
}

// SPDX-License-Identifier: Apache-2.0
// Attributes of the vertex stage: a vertex, and the instance that it is drawn for.
layout(location = 0) in vec4 inPosition; // w: of strips the half width, negative on the right; else 0
layout(location = 1) in vec3 inNormal; // of strips: along the curve, as long as a StripEnd
#define PATINA_ATTRIBUTE(place, type, name) layout(location = place) in type name;
#include "shaders/raster/instanceFields.glsl"
#undef PATINA_ATTRIBUTE

vec3 worldPosition() {
    mat4 toWorld = mat4(vec4(column0.xyz, 0.0), vec4(column1.xyz, 0.0), vec4(column2.xyz, 0.0),
                        vec4(column3.xyz, 1.0));
    return (toWorld * vec4(inPosition.xyz, 1.0)).xyz;
}

vec3 alongStrip() {
    return mat3(column0.xyz, column1.xyz, column2.xyz) * inNormal;
}
// Of a strip's vertex: places on the cross-section of the tube, in radii; x is across, y towards who looks. A
// dome is as high as the tube in the mean.
vec2 onStrip() {
    if (inPosition.w == 0.0) return vec2(0.0);
    vec2 at = length(inNormal) > 7.0 ? vec2(0.6, 0.98) : vec2(1.0, 0.0);
    return vec2(inPosition.w < 0.0 ? -at.x : at.x, at.y);
}
// Where a vertex is for one who looks: a strip faces him, as wide as the outline of the tube.
// viewer: position, or direction to it where w is 0.
vec3 positionFor(vec4 viewer) {
    vec3 p = worldPosition();
    if (inPosition.w == 0.0) return p;
    vec3 d = viewer.w != 0.0 ? viewer.xyz - p : viewer.xyz;
    vec3 across = cross(alongStrip(), d);
    float r = inPosition.w * column0.w, l = length(across), away = dot(d, d);
    if (viewer.w != 0.0) r *= inversesqrt(max(1.0 - r * r / max(away, 1e-30), 0.1));
    if (l <= 0.0) return p;
    // The outline of an open tube has half an ellipse beyond its end, that of a round one half a circle:
    // a strip gets as much longer.
    float kind = round(length(inNormal));
    if (kind > 7.0) kind -= 8.0;
    if (kind > 1.0) {
        vec3 along = normalize(alongStrip()), towards = d * inversesqrt(max(away, 1e-30));
        float c = dot(along, towards);
        vec3 beyond = (along - towards * c) * inversesqrt(max(1.0 - c * c, 1e-6));
        float more = 0.785398 * abs(r) * (kind > 3.5 ? 1.0 : abs(c));
        p += beyond * (kind == 2.0 || kind == 4.0 ? more : -more);
    }
    vec2 at = onStrip();
    p += across * (abs(r) * at.x / l);
    if (at.y > 0.0) p += normalize(cross(across, alongStrip())) * (abs(r) * at.y);
    return p;
}

// Shadows of lights' samples, and of directions that are none, by the cells of the sky.
layout(std430, binding = 5) readonly buffer ShadowMatrices { mat4 shadowMatrices[]; };
struct SkyCell {
    mat4 worldToMap;
    vec4 towards; // the direction drawn; w: width of a texel
    ivec4 map;    // x: layer
};
layout(std430, binding = 10) readonly buffer SkyCells { SkyCell skyCells[]; };
layout(binding = 18) uniform sampler2DArrayShadow shadowMaps;
layout(binding = 19) uniform sampler2DArrayShadow skyMaps;

// The shaded point, moved off its surface by what a texel may be wrong.
vec3 offSurface(vec3 wi, float texel) {
    float side = dot(point.geometricNormal, wi) < 0.0 ? -1.0 : 1.0;
    float sine = sqrt(max(1.0 - pow(dot(point.geometricNormal, wi), 2.0), 0.0));
    return point.position + point.geometricNormal * (side * texel * (0.3 + 0.6 * sine));
}

// Whether a light's sample reaches a point, as far as its maps tell.
float reaches(Light l, vec3 p) {
    int map = int(l.shadow.x);
    if (l.shadow.y > 1.0) {
        vec3 d = p - l.sampled.xyz;
        vec3 a = abs(d);
        map += a.x >= a.y && a.x >= a.z ? (d.x > 0.0 ? 0 : 1)
               : a.y >= a.z            ? (d.y > 0.0 ? 2 : 3)
                                       : (d.z > 0.0 ? 4 : 5);
    }
    vec4 clip = shadowMatrices[map] * vec4(p, 1.0);
    if (clip.w <= 0.0) return 1.0;
    vec3 q = clip.xyz / clip.w * 0.5 + 0.5;
    if (any(lessThan(q, vec3(0.0))) || any(greaterThan(q, vec3(1.0)))) return 1.0;
    return texture(shadowMaps, vec4(q.xy, float(map), q.z));
}

// Share of the light's sample that arrives; the colour of shadows where it does not.
vec3 shadowAt(Light l, vec3 wi) {
    if (l.shadow.x < 0.0) return vec3(1.0);
    float away = l.shadow.w != 0.0 ? length(point.position - l.sampled.xyz) : 1.0;
    vec3 p = offSurface(wi, l.shadow.z * away);
    float seen = reaches(l, p);
    if (seen < 1.0 && l.fade.x > 0.0) {
        // What is nearest to the light is further off than h where the point moved by h is lit.
        int steps = l.fade.y > 0.0 ? 8 : 1;
        float start = l.fade.y > 0.0 ? max(l.fade.x - l.fade.y, 0.0) : l.fade.x;
        float blocked = 0.0, last = 1.0 - seen, depth = 1.0;
        for (int i = 0; i < steps; ++i) {
            float h = steps > 1 ? mix(start, l.fade.x, (float(i) + 0.5) / float(steps)) : start;
            float now = l.shadow.w != 0.0 && h >= away ? 0.0 : min(1.0 - reaches(l, p + wi * h), last);
            blocked += (last - now) * depth;
            depth = steps > 1 ? pow(clamp((l.fade.x - h) / l.fade.y, 0.0, 1.0), l.fade.z) : 0.0;
            last = now;
        }
        seen = 1.0 - blocked;
    }
    return mix(l.shadowColor.rgb, vec3(1.0), seen);
}

vec2 octahedral(vec3 w) {
    vec3 a = w / (abs(w.x) + abs(w.y) + abs(w.z));
    vec2 sides = vec2(a.x >= 0.0 ? 1.0 : -1.0, a.y >= 0.0 ? 1.0 : -1.0);
    return 0.5 + 0.5 * (a.z >= 0.0 ? a.xy : (1.0 - abs(a.yx)) * sides);
}

// Whether light from infinitely far comes to the point along wi, by the map of the cell that wi is
// in: right but for what is thinner than a cell is wide.
float skyReaches(vec3 wi) {
    if (lightInfo.z == 0) return 1.0;
    ivec2 at = min(ivec2(octahedral(wi) * float(lightInfo.z)), ivec2(lightInfo.z - 1));
    int cell = at.y * lightInfo.z + at.x;
    vec3 towards = skyCells[cell].towards.xyz;
    // A direction beside the sample's may be under the horizon where the sample is not.
    if (dot(towards, point.geometricNormal) * dot(wi, point.geometricNormal) <= 0.0) towards = wi;
    vec4 clip = skyCells[cell].worldToMap * vec4(offSurface(towards, skyCells[cell].towards.w), 1.0);
    vec3 q = clip.xyz * 0.5 + 0.5;
    if (any(lessThan(q, vec3(0.0))) || any(greaterThan(q, vec3(1.0)))) return 1.0;
    return texture(skyMaps, vec4(q.xy, float(skyCells[cell].map.x), q.z));
}

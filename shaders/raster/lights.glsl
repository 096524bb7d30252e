// Lights as a pass knows them, and their shapes. See hdDelegate/raster/lights/rasterLight.h.

#include "shaders/lib/sphereLight.glsl"

struct Light {
    vec4 sampled;  // xyz: position, or direction to the light; w: 1 position, 0 direction
    vec4 normal;   // of the emitter at the sample; w: density by area, by length, or by solid angle
    vec4 radiance; // w: kind. Of domes that of the sample
    vec4 origin;   // of the shape, or a dome's radiance without its image; w: 1 delta
    vec4 axis0, axis1, axis2;          // shape to world; w: samples that a pixel takes of it (0: one, of a dome cone.y), -, category that is lit (-1 all)
    vec4 inverse0, inverse1, inverse2; // world to shape; w: diffuse, specular, 1 seen by the camera
    vec4 shaping;   // axis; w: focus
    vec4 focusTint; // w: cosine cutoff is on
    vec4 cone;      // x start, y end, radians; z 1 - cos of a distant light, w its solid angle.
                    // Of domes: x layer of the image (-1 none), y samples, z first of its harmonics
                    // (-1 none). Of distant lights: x 1 the sun of a dome. Of triangles: z 1 two-sided
    vec4 shadow;    // x first map (-1 none), y maps (0: the sky's), z for fibres; w 0 parallel, 1 perspective,
                    // from 2 on: perspective, from the place of the light with this number less 2
    vec4 shadowColor; // w: density by area of a rect or disk without an image
    vec4 fade;      // of shadows: distance, falloff, gamma; w: how often the light counts
    vec4 table;     // x first value of an image (-1 none), y width, z height; w first of a profile (-1)
                    // Of triangles: x first of RasterEmission (-1 even), y steps of the angle, z of the turn
    vec4 shapingX;  // local x across the axis; w: thetas of the profile
    vec4 shapingY;  // w: phis
};
#ifdef ALL_LIGHTS
layout(std430, binding = 4) readonly buffer Lights { Light lights[]; };
#else
// Those that the pass takes: drivers read uniform blocks faster than storage.
layout(std140, binding = 4) uniform Lights { Light lights[208]; }; // RasterLights::maxTaken
#endif
layout(std430, binding = 8) readonly buffer LightTables { vec4 lightTables[]; };

const int LIGHT_RECT = 0;
const int LIGHT_DISK = 1;
const int LIGHT_SPHERE = 2;
const int LIGHT_CYLINDER = 3;
const int LIGHT_POINT = 4;
const int LIGHT_DISTANT = 5;
const int LIGHT_DOME = 6;
// Found by their samples only: further samples of a dome, lines, glowing triangles.
const int LIGHT_MORE_DOME = 7;
const int LIGHT_LINE = 8;
const int LIGHT_TRIANGLE = 9;

layout(binding = 16) uniform sampler2DArray domeMaps;
layout(binding = 17) uniform sampler2DArray domeDensities;

vec2 latlong(vec3 d) {
    float u = 0.5 - atan(d.x, d.z) / TWO_PI;
    return vec2(u, acos(clamp(d.y, -1.0, 1.0)) * INV_PI);
}

vec3 toDome(Light l, vec3 w) {
    return vec3(dot(l.axis0.xyz, w), dot(l.axis1.xyz, w), dot(l.axis2.xyz, w));
}
// lod: of the map's mip chain.
vec3 radianceOfDome(Light l, vec3 w, float lod) {
    if (l.cone.x < 0.0) return l.origin.xyz;
    return l.origin.xyz * textureLod(domeMaps, vec3(latlong(toDome(l, w)), l.cone.x), lod).rgb;
}
// lod: as radianceOfDome. What looks into a smaller version of the image must weigh itself by as small
// a one of the density, else what is bright beside it counts twice.
float domePdf(Light l, vec3 w, float lod) {
    if (l.cone.x < 0.0) return 0.25 * INV_PI;
    float finer = 0.5 * log2(2.0 * max(extra.x, 1.0)) - log2(float(textureSize(domeDensities, 0).x));
    return textureLod(domeDensities, vec3(latlong(toDome(l, w)), l.cone.x), max(lod - finer, 0.0)).x;
}
// The profile in a direction away from the light, as LightShaping::factor().
float profileFactor(Light l, vec3 away, float theta) {
    float phi = atan(-dot(away, l.shapingY.xyz), -dot(away, l.shapingX.xyz)) / TWO_PI;
    float x = theta * INV_PI * (l.shapingX.w - 1.0), y = fract(phi) * (l.shapingY.w - 1.0);
    int thetas = int(l.shapingX.w), i = int(min(x, l.shapingX.w - 2.0)), k = int(y);
    int at = int(l.table.w) + k * thetas + i;
    float low = mix(lightTables[at].x, lightTables[at + 1].x, x - float(i));
    if (l.shapingY.w < 2.0) return low;
    float high = mix(lightTables[at + thetas].x, lightTables[at + thetas + 1].x, x - float(i));
    return mix(low, high, y - float(k));
}

vec3 shapingFactor(Light l, vec3 away) {
    vec3 f = vec3(1.0);
    float c = clamp(dot(away, l.shaping.xyz), -1.0, 1.0);
    if (l.shaping.w > 0.0) {
        float t = pow(max(abs(c), 1e-20), l.shaping.w);
        f = mix(l.focusTint.rgb, vec3(1.0), t);
    }
    if (l.focusTint.w == 0.0 && l.table.w < 0.0) return f;
    float angle = acos(c);
    if (l.focusTint.w > 0.0)
        f *= l.cone.y > l.cone.x ? 1.0 - smoothstep(l.cone.x, l.cone.y, angle)
                                 : (angle > l.cone.y ? 0.0 : 1.0);
    if (l.table.w >= 0.0) f *= profileFactor(l, away, angle);
    return f;
}

vec3 toShape(Light l, vec3 v) {
    return l.inverse0.xyz * v.x + l.inverse1.xyz * v.y + l.inverse2.xyz * v.z;
}
vec3 fromShape(Light l, vec3 v) {
    return l.axis0.xyz * v.x + l.axis1.xyz * v.y + l.axis2.xyz * v.z;
}

// World normal of a normal in the shape's coordinates; its length is that of the inverse transpose.
vec3 shapeNormal(Light l, vec3 n) {
    return vec3(dot(l.inverse0.xyz, n), dot(l.inverse1.xyz, n), dot(l.inverse2.xyz, n));
}

// A rect's image at a position in the shape's coordinates: radiance factor, and density of samples
// relative to uniform.
vec4 imageOfRect(Light l, vec2 q) {
    if (l.table.x < 0.0) return vec4(1.0);
    vec2 size = l.table.yz, at = clamp((0.5 - q) * size - 0.5, vec2(0.0), size - 1.0);
    ivec2 low = ivec2(at), high = min(low + 1, ivec2(size) - 1);
    int first = int(l.table.x), w = int(size.x);
    vec2 t = at - vec2(low);
    vec4 value = mix(mix(lightTables[first + low.y * w + low.x], lightTables[first + low.y * w + high.x], t.x),
                     mix(lightTables[first + high.y * w + low.x], lightTables[first + high.y * w + high.x], t.x), t.y);
    ivec2 cell = clamp(ivec2((0.5 - q) * size), ivec2(0), ivec2(size) - 1);
    return vec4(value.rgb, lightTables[first + cell.y * w + cell.x].w);
}

// What a glowing triangle gives in a direction away from it, see RasterEmission.
vec3 emissionOfTriangle(Light l, vec3 away) {
    if (l.table.x < 0.0) return vec3(1.0);
    int steps = int(l.table.y);
    float x = acos(clamp(dot(away, l.shaping.xyz), -1.0, 1.0)) * INV_PI * (l.table.y - 1.0);
    int i = min(int(x), steps - 2), at = int(l.table.x) + i;
    float share = x - float(i);
    vec3 low = mix(lightTables[at].rgb, lightTables[at + 1].rgb, share);
    if (l.table.z < 2.0) return low;
    float y = fract(atan(dot(away, l.shapingY.xyz), dot(away, l.shapingX.xyz)) / TWO_PI) * (l.table.z - 1.0);
    int k = min(int(y), int(l.table.z) - 2);
    at += k * steps;
    low = mix(lightTables[at].rgb, lightTables[at + 1].rgb, share);
    vec3 high = mix(lightTables[at + steps].rgb, lightTables[at + steps + 1].rgb, share);
    return mix(low, high, y - float(k));
}

// First point of the emitting side that a ray meets; density by solid angle of what samples draw, and
// the factor of the radiance there that is not the shaping's.
bool lightHit(Light l, vec3 origin, vec3 direction, out float t, out float density, out vec3 image) {
    int kind = int(l.radiance.w);
    image = vec3(1.0);
    if (l.origin.w > 0.0 || kind > LIGHT_CYLINDER) return false;
    vec3 o = toShape(l, origin - l.origin.xyz);
    vec3 d = toShape(l, direction);
    if (kind == LIGHT_RECT || kind == LIGHT_DISK) {
        t = -o.z / d.z;
        vec3 q = o + d * t;
        float c = -dot(l.normal.xyz, direction);
        bool inside = kind == LIGHT_RECT ? max(abs(q.x), abs(q.y)) <= 0.5 : dot(q.xy, q.xy) <= 1.0;
        if (!(t > 0.0 && inside && c > 0.0)) return false;
        vec4 value = imageOfRect(l, q.xy);
        image = value.rgb;
        density = l.shadowColor.w * value.w * t * t / max(c, 1e-10);
        return true;
    }
    float volume = abs(dot(cross(l.axis0.xyz, l.axis1.xyz), l.axis2.xyz));
    if (kind == LIGHT_SPHERE) return sphereLightHit(o, d, volume, t, density);
    float a = dot(d.yz, d.yz), middle = -dot(o.yz, d.yz) / max(a, 1e-30);
    vec2 nearest = o.yz + d.yz * middle;
    float chord = 1.0 - dot(nearest, nearest);
    if (chord <= 0.0 || dot(o.yz, o.yz) <= 1.0) return false;
    t = middle - sqrt(chord / max(a, 1e-30));
    vec3 q = o + d * t;
    if (t <= 0.0 || abs(q.x) > 0.5) return false;
    vec3 wide = shapeNormal(l, vec3(0.0, q.yz)); // as long as the area is small
    density = 0.5 * INV_PI / volume * t * t / max(-dot(wide, direction), 1e-10);
    return true;
}

// A light's sample as a point meets it. wi: to it; reach: how far it is; density: of all samples of the
// light, by solid angle, 1 of lights that are no area.
// @returns radiance towards the point, or irradiance of what is no area; with how often the light counts
vec3 lightSample(Light l, vec3 p, out vec3 wi, out float density, out float reach) {
    int kind = int(l.radiance.w);
    vec3 radiance = l.radiance.xyz * l.fade.w;
    wi = l.sampled.xyz;
    reach = 1e30;
    density = l.origin.w > 0.0 ? 1.0 : l.normal.w;
    if (kind == LIGHT_DOME || kind == LIGHT_MORE_DOME) density *= l.cone.y;
    if (l.sampled.w == 0.0) return radiance;
    vec3 d = l.sampled.xyz - p;
    float d2 = max(dot(d, d), 1e-20);
    reach = sqrt(d2);
    wi = d / reach;
    if (kind == LIGHT_SPHERE) {
        float volume = abs(dot(cross(l.axis0.xyz, l.axis1.xyz), l.axis2.xyz));
        sphereLightHit(toShape(l, p - l.origin.xyz), toShape(l, wi), volume, reach, density);
        if (density <= 0.0) return vec3(0.0);
        return radiance * shapingFactor(l, -wi);
    }
    radiance *= shapingFactor(l, -wi);
    if (l.origin.w > 0.0) {
        if (kind != LIGHT_LINE) return radiance / d2;
        float along = dot(wi, l.axis0.xyz);
        return radiance / d2 * (sqrt(max(1.0 - along * along, 0.0)) / l.normal.w);
    }
    if (kind == LIGHT_RECT && l.table.x >= 0.0)
        radiance *= imageOfRect(l, toShape(l, l.sampled.xyz - l.origin.xyz).xy).rgb;
    float c = -dot(l.normal.xyz, wi);
    if (kind == LIGHT_TRIANGLE) {
        if (l.cone.z != 0.0) c = abs(c);
        radiance *= emissionOfTriangle(l, -wi);
    }
    if (c <= 0.0) return vec3(0.0);
    density *= d2 / c;
    return radiance;
}

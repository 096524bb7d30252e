// Lights and shadows of a pass.
#include "shaders/raster/passBlock.glsl"

// One light with the sample of it that this pass takes.
struct Light {
    vec4 sampled;  // xyz: position, or direction to the light; w: 1 position, 0 direction
    vec4 normal;   // of the emitter at the sample; w: density by area, or by solid angle
    vec4 radiance; // w: kind
    vec4 origin;   // of the shape; w: 1 delta
    vec4 axis0, axis1, axis2;          // shape to world; w: -, -, category that is lit (-1 all)
    vec4 inverse0, inverse1, inverse2; // world to shape; w: diffuse, specular, 1 seen by the camera
    vec4 shaping;  // axis; w: focus
    vec4 focusTint; // w: cosine cutoff is on
    vec4 cone;     // x start, y end, radians; z 1 - cos of a distant light, w its solid angle
    vec4 shadow;   // x first map (-1 none), y maps, z width of a texel (per distance), w 1 perspective
    vec4 shadowColor;
};
layout(std430, binding = 4) readonly buffer Lights { Light lights[]; };
layout(std430, binding = 5) readonly buffer ShadowMatrices { mat4 shadowMatrices[]; };

const int LIGHT_RECT = 0;
const int LIGHT_DISK = 1;
const int LIGHT_SPHERE = 2;
const int LIGHT_CYLINDER = 3;
const int LIGHT_POINT = 4;
const int LIGHT_DISTANT = 5;
const int LIGHT_DOME = 6;
// Found by their samples only: further samples of the dome, other domes, glowing triangles.
const int LIGHT_MORE_DOME = 7;
const int LIGHT_OTHER_DOME = 8;
const int LIGHT_TRIANGLE = 9;

layout(binding = 16) uniform sampler2D domeMap;
layout(binding = 17) uniform sampler2D domeDensity;
layout(binding = 18) uniform sampler2DArrayShadow shadowMaps;

uint hash(uint x) { // PCG (Jarzynski and Olano 2020)
    uint s = x * 747796405u + 2891336453u;
    uint w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return (w >> 22u) ^ w;
}
// Owen's scrambling by a hash (Laine and Karras 2011, constants as in hdDelegate/film/sampler.h).
uint scramble(uint x, uint seed) {
    x = bitfieldReverse(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return bitfieldReverse(x);
}
// Pair `set` of sample `index` of a pixel: Owen-scrambled Sobol points (Burley 2020).
vec2 randomAt(uvec2 pixel, uint index, uint set) {
    uint seed = hash(pixel.x + hash(pixel.y + hash(set + 64u * uint(counts.w))));
    uint i = scramble(index, seed);
    // The second dimension is Pascal's triangle modulo 2, a Kronecker power: five steps for 32 bits.
    uint y = i ^ (i >> 16);
    y ^= (y & 0xff00ff00u) >> 8;
    y ^= (y & 0xf0f0f0f0u) >> 4;
    y ^= (y & 0xccccccccu) >> 2;
    y ^= (y & 0xaaaaaaaau) >> 1;
    uvec2 bits = uvec2(scramble(bitfieldReverse(i), hash(seed + 0x68bc21ebu)),
                       scramble(bitfieldReverse(y), hash(seed + 0x02e5be93u)));
    return vec2(bits >> 8u) * (1.0 / 16777216.0);
}

vec2 latlong(vec3 d) {
    float u = 0.5 - atan(d.x, d.z) / TWO_PI;
    return vec2(u, acos(clamp(d.y, -1.0, 1.0)) * INV_PI);
}

// lod: of the map's mip chain.
vec3 domeRadiance(vec3 w, float lod) {
    if (dome.w == 0.0) return vec3(0.0);
    vec3 d = transpose(mat3(domeToWorld)) * w;
    vec3 image = domeInfo.w != 0 ? textureLod(domeMap, latlong(d), lod).rgb : vec3(1.0);
    return dome.rgb * image;
}
float domePdf(vec3 w) {
    if (domeInfo.w == 0) return 0.25 * INV_PI;
    vec3 d = transpose(mat3(domeToWorld)) * w;
    return textureLod(domeDensity, latlong(d), 0.0).x;
}

vec3 shapingFactor(Light l, vec3 away) {
    vec3 f = vec3(1.0);
    float c = dot(away, l.shaping.xyz);
    if (l.shaping.w > 0.0) {
        float t = pow(max(abs(c), 1e-20), l.shaping.w);
        f = mix(l.focusTint.rgb, vec3(1.0), t);
    }
    if (l.focusTint.w > 0.0) {
        float angle = acos(clamp(c, -1.0, 1.0));
        f *= l.cone.y > l.cone.x ? 1.0 - smoothstep(l.cone.x, l.cone.y, angle)
                                 : (angle > l.cone.y ? 0.0 : 1.0);
    }
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

// First point of the emitting side that a ray meets; density by area of what lightSamples draw.
bool lightHit(Light l, vec3 origin, vec3 direction, out float t, out vec3 n, out float density) {
    int kind = int(l.radiance.w);
    if (l.origin.w > 0.0 || kind > LIGHT_CYLINDER) return false;
    vec3 o = toShape(l, origin - l.origin.xyz);
    vec3 d = toShape(l, direction);
    density = l.normal.w;
    if (kind == LIGHT_RECT || kind == LIGHT_DISK) {
        n = l.normal.xyz;
        t = -o.z / d.z;
        vec3 q = o + d * t;
        bool inside = kind == LIGHT_RECT ? max(abs(q.x), abs(q.y)) <= 0.5 : dot(q.xy, q.xy) <= 1.0;
        return t > 0.0 && inside && dot(n, direction) < 0.0;
    }
    vec3 mask = kind == LIGHT_SPHERE ? vec3(1.0) : vec3(0.0, 1.0, 1.0);
    vec3 om = o * mask, dm = d * mask;
    float a = dot(dm, dm), b = dot(om, dm), c = dot(om, om) - 1.0;
    float discriminant = b * b - a * c;
    if (discriminant <= 0.0 || a <= 0.0 || c <= 0.0) return false;
    t = (-b - sqrt(discriminant)) / a;
    vec3 q = o + d * t;
    if (t <= 0.0 || (kind == LIGHT_CYLINDER && abs(q.x) > 0.5)) return false;
    vec3 wide = shapeNormal(l, q * mask);
    float length2 = length(wide);
    n = wide / length2;
    float det = abs(dot(cross(l.axis0.xyz, l.axis1.xyz), l.axis2.xyz));
    density = (kind == LIGHT_SPHERE ? 0.25 * INV_PI : 0.5 * INV_PI) / (det * length2);
    return true;
}

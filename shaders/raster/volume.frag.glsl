// SPDX-License-Identifier: Apache-2.0
// A volume prim over what is drawn already: one place where light scatters is drawn from each ray's
// steps and lit, by light that is scattered there for the first time and by what diffuses.
#include "shaders/compat/glsl.glsl"
#define LIGHT_FILTERS
#include "shaders/raster/pass.glsl"
#include "shaders/raster/cameraRay.glsl"
layout(location = 0) out vec4 outColor;
layout(location = 10) uniform mat4 worldToObject;
layout(location = 14) uniform vec3 boundsMin;
layout(location = 15) uniform vec3 boundsMax;
layout(location = 16) uniform int volumeIndex;
layout(binding = 0) uniform sampler3D scatteringMap; // w: mean cosine
layout(binding = 1) uniform sampler3D extinctionMap;
layout(binding = 2) uniform sampler3D emissionMap;
layout(binding = 21) uniform sampler2D sceneColor;
layout(binding = 22) uniform sampler2D sceneDepth;

// The shaded point, which shadows.glsl asks for.
struct VolumePoint {
    vec3 position;
    vec3 geometricNormal;
} point;
bool isTube() {
    return false;
}
vec3 planeTowards(vec3 towards) {
    return point.geometricNormal;
}
vec3 departure(vec3 wi) {
    return point.position;
}
#include "shaders/raster/shadows.glsl"

const int CAMERA_STEPS = 48;
const int LIGHT_STEPS = 10;

// Where a ray is inside the box.
bool boxAlong(vec3 origin, vec3 direction, inout float near, inout float far) {
    vec3 o = (worldToObject * vec4(origin, 1.0)).xyz;
    vec3 d = mat3(worldToObject) * direction;
    vec3 inverseD = 1.0 / mix(d, vec3(1e-20), equal(d, vec3(0.0)));
    vec3 a = (boundsMin - o) * inverseD, b = (boundsMax - o) * inverseD;
    vec3 low = min(a, b), high = max(a, b);
    near = max(near, max(low.x, max(low.y, low.z)));
    far = min(far, min(high.x, min(high.y, high.z)));
    return near < far;
}
vec3 inMaps(vec3 p) {
    return ((worldToObject * vec4(p, 1.0)).xyz - boundsMin) / (boundsMax - boundsMin);
}

// Optical depth on a way through the volume, and how much of it scatters, where forward scattering counts
// as none (similarity).
void opticalDepth(vec3 p, vec3 direction, float reach, float jitter, inout vec3 depth, inout vec3 scattering) {
    float near = 0.0, far = reach;
    if (!boxAlong(p, direction, near, far)) return;
    float dt = (far - near) / float(LIGHT_STEPS);
    for (int i = 0; i < LIGHT_STEPS; ++i) {
        vec3 at = inMaps(p + direction * (near + (float(i) + jitter) * dt));
        vec4 s = textureLod(scatteringMap, at, 0.0);
        depth += (textureLod(extinctionMap, at, 0.0).rgb - s.w * s.rgb) * dt;
        scattering += (1.0 - s.w) * s.rgb * dt;
    }
}

// Fluence of light that was scattered before, per irradiance, at a depth in a layer with light from
// above: diffusion with Marshak's boundaries (Ishimaru 1978, Wave Propagation and Scattering in Random
// Media, chapter 9). Grows from 0 in thin layers to 5 deep in thick white ones.
vec3 diffused(vec3 depth, vec3 layer, vec3 albedo) {
    vec3 k = sqrt(clamp(3.0 * (1.0 - albedo), 0.001, 3.0));
    k = mix(k, vec3(0.98), lessThan(abs(k - 1.0), vec3(0.02))); // 1 is a removable pole
    vec3 source = (k * k - 3.0) / (1.0 - k * k);
    vec3 m = 1.0 + k * (2.0 / 3.0), through = exp(-k * layer), n = (1.0 - k * (2.0 / 3.0)) * through;
    vec3 top = source * (-5.0 / 3.0), bottom = source * exp(-layer) * (-1.0 / 3.0);
    vec3 det = m * m - n * n;
    return max((m * top - n * bottom) / det * exp(-k * depth) +
                   (m * bottom - n * top) / det * exp(-k * (layer - depth)) + source * exp(-depth),
               vec3(0.0));
}

// Light scattered towards the camera, of irradiance from a direction, per scattering coefficient. Light that
// scatters once follows the phase function; light that scatters many times is that of a layer across the
// direction. Clouds are no layers and lose light at their sides, hence the division by the root: `both` is the
// light that a white cloud would gather from everywhere, which must not be above 1. The exponent was fitted to
// the cloud of testenv/scenes/volume.usda.
vec3 lightInside(vec3 p, vec3 direction, float reach, float jitter, float phase) {
    vec3 depth = vec3(0.0), scattering = vec3(0.0);
    opticalDepth(p, direction, reach, jitter, depth, scattering);
    vec3 layer = depth;
    opticalDepth(p, -direction, 1e30, jitter, layer, scattering);
    vec3 albedo = scattering / max(layer, vec3(1e-20));
    vec3 both = exp(-depth) + diffused(depth, layer, vec3(1.0)) + exp(depth - layer) +
                diffused(layer - depth, layer, vec3(1.0));
    return (phase * exp(-depth) + diffused(depth, layer, albedo) * (0.25 * INV_PI)) / sqrt(0.5 * both);
}

vec3 evenDirection(vec2 u) {
    float z = 1.0 - 2.0 * u.x, r = sqrt(max(1.0 - z * z, 0.0));
    return vec3(r * cos(TWO_PI * u.y), r * sin(TWO_PI * u.y), z);
}

float henyeyGreenstein(float g, float c) {
    float d = max(1.0 + g * g - 2.0 * g * c, 1e-6);
    return 0.25 * INV_PI * (1.0 - g * g) / (d * sqrt(d));
}

vec3 litAt(vec3 p, vec3 direction, float g, float jitter) {
    vec3 sum = vec3(0.0);
    point.position = p;
    for (int i = firstSampled; i < lightsTaken; ++i) {
        Light l = lights[i];
        if ((l.flags & LIGHT_OF_DOME) != 0) continue;
        if (l.kind == LIGHT_DOME && l.domeSamples == 0.0) { // nobody samples it: its mean
            vec3 from = evenDirection(vec2(jitter, fract(17.0 * jitter)));
            sum += radianceOfDome(l, direction, max(float(domeLevel) - 1.0, 0.0)) * l.weight *
                   filterFactor(l, p, from, LIGHT_FAR) * lightInside(p, from, LIGHT_FAR, jitter, 0.25 * INV_PI) *
                   (4.0 * PI * l.specular);
            continue;
        }
        vec3 wi;
        float density, reach;
        vec3 radiance = lightSample(l, p, wi, density, reach);
        if (radiance == vec3(0.0)) continue;
        point.geometricNormal = wi;
        sum += radiance / density * shadowAt(l, wi) *
               lightInside(p, wi, reach, jitter, henyeyGreenstein(g, dot(direction, wi))) * l.specular;
    }
    return sum;
}

void main() {
    vec3 origin, direction;
    vec2 seen = cameraRay(origin, direction);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float near = seen.x, far = seen.y, depth = texelFetch(sceneDepth, pixel, 0).x;
    if (depth < 1.0) {
        vec4 world = clipToWorld * vec4(vWindow, depth * 2.0 - 1.0, 1.0);
        far = min(far, dot(world.xyz / world.w - origin, direction));
    }
    if (!boxAlong(origin, direction, near, far)) discard;
    vec2 u = randomAt(uvec2(pixel), uint(passIndex), 40u + 2u * uint(volumeIndex));
    vec2 v = randomAt(uvec2(pixel), uint(passIndex), 41u + 2u * uint(volumeIndex));
    float dt = (far - near) / float(CAMERA_STEPS);
    vec3 transmittance = vec3(1.0), glowing = vec3(1.0), emitted = vec3(0.0), scattered = vec3(0.0), drawn = vec3(0.0);
    float total = 0.0, own = 0.0, where = near, g = 0.0, choice = u.y;
    for (int i = 0; i < CAMERA_STEPS; ++i) {
        float t = near + (float(i) + u.x) * dt;
        vec3 at = inMaps(origin + direction * t);
        vec4 s = textureLod(scatteringMap, at, 0.0);
        vec3 sigma = textureLod(extinctionMap, at, 0.0).rgb;
        vec3 next = transmittance * exp(-sigma * dt);
        vec3 stretch = mix((transmittance - next) / max(sigma, vec3(1e-20)), transmittance * dt,
                           lessThan(sigma * dt, vec3(1e-4)));
        // Light of a glow inside comes out scattered, too: only as much is lost as where it diffuses.
        vec3 lost = max(sigma - s.rgb, vec3(0.0));
        lost = min(sqrt(3.0 * lost * (sigma - s.w * s.rgb)), sigma);
        vec3 dimmed = glowing * exp(-lost * dt);
        emitted += textureLod(emissionMap, at, 0.0).rgb *
                   mix((glowing - dimmed) / max(lost, vec3(1e-20)), glowing * dt, lessThan(lost * dt, vec3(1e-4)));
        glowing = dimmed;
        vec3 part = s.rgb * stretch;
        float weight = part.x + part.y + part.z;
        total += weight;
        if (weight > 0.0) {
            float share = weight / total;
            if (choice < share) {
                choice /= share;
                drawn = part;
                own = weight;
                where = t;
                g = s.w;
            } else {
                choice = (choice - share) / max(1.0 - share, 1e-20);
            }
        }
        transmittance = next;
    }
    if (own > 0.0)
        scattered = drawn * (total / own) * litAt(origin + direction * where, direction, g, v.x);
    vec4 behind = texelFetch(sceneColor, pixel, 0);
    outColor = vec4(behind.rgb * transmittance + (emitted + scattered) * exposure,
                    mix(1.0, behind.a, dot(transmittance, vec3(0.2126, 0.7152, 0.0722))));
}

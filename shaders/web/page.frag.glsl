// Ends the fragment shader of a material on the page: a few samples of the BSDF find environment and
// lights, and one sample of each light; the host averages over passes. The environment is read where
// its mip level is as coarse as the samples are sparse (filtered importance sampling, Colbert and
// Krivanek 2007).
#include "shaders/web/environment.glsl"
#include "shaders/web/random.glsl"
#include "shaders/web/lights.glsl"

uniform vec3 eye;
uniform float pixelAngle;
uniform ivec4 passInfo; // index, samples in this pass, samples in all passes, flags
uniform vec2 environmentInfo; // texels, levels
const int PAGE_CLOSED = 1; // a shape with an inside: no light from behind comes through

out vec4 outColor;

float heuristic(float a, float b) {
    return a * a / max(a * a + b * b, 1e-30);
}

void setPagePoint() {
    vec3 dx = dFdx(vPosition), dy = dFdy(vPosition);
    vec3 view = eye - vPosition;
    float distance = length(view);
    point.view = view / max(distance, 1e-20);
    vec3 g = cross(dx, dy);
    float area = length(g);
    g = area > 0.0 ? g / area : point.view;
    if (dot(g, point.view) < 0.0) g = -g;
    point.geometricNormal = gl_FrontFacing ? g : -g;
    point.position = vPosition;
    point.objectPosition = vObjectPosition;
    point.normal = unitOr(vNormal, point.geometricNormal);
    if (dot(point.normal, point.geometricNormal) < 0.0) point.normal = -point.normal;
    vec3 t = vTangent.xyz - point.normal * dot(point.normal, vTangent.xyz);
    point.tangent = unitOr(t, anyTangent(point.normal));
    point.bitangent = cross(point.normal, point.tangent) * (vTangent.w < 0.0 ? -1.0 : 1.0);
    point.objectToWorldNormal = normalToWorld;
    vec2 ux = dFdx(vUv), uy = dFdy(vUv);
    float uvArea = abs(ux.x * uy.y - ux.y * uy.x);
    float perLength = sqrt(uvArea / max(area, 1e-20));
    float cosine = max(0.1, abs(dot(g, point.view)));
    point.uvFootprint = perLength * pixelAngle * distance / sqrt(cosine);
}

bool isBlocked(vec3 wi) {
    bool behind = (dot(wi, point.geometricNormal) > 0.0) != woOutside();
    return behind && (passInfo.w & PAGE_CLOSED) != 0;
}

vec3 fromLight(int i, vec2 u) {
    PageLight l = lightAt(i);
    vec3 wi;
    float density;
    vec3 radiance = sampleLight(l, point.position, u, wi, density);
    if (radiance == vec3(0.0) || isBlocked(wi)) return vec3(0.0);
    MaterialEval f = materialEval(wi);
    vec3 value = f.diffuse * l.shares.x + f.specular * l.shares.y;
    if (density == 0.0) return value * radiance;
    float found = l.kind == LIGHT_CYLINDER ? 0.0 : float(passInfo.y) * f.pdf;
    return value * radiance * heuristic(density, found) / density;
}

vec3 along(MaterialSample s) {
    bool delta = (s.event & LOBE_DELTA) != 0;
    float apart = float(passInfo.z) * s.pdf * 4.0 * PI / environmentInfo.x;
    float lod = delta ? 0.0 : clamp(-0.5 * log2(max(apart, 1e-20)), 0.0, environmentInfo.y);
    vec3 sum = s.weight * environmentAt(s.wi, lod);
    if (isBlocked(s.wi)) return sum;
    for (int i = 0; i < lightCount; ++i) {
        PageLight l = lightAt(i);
        float density;
        vec3 radiance = lightAlong(l, point.position, s.wi, density);
        if (density == 0.0) continue;
        float weight = delta ? 1.0 : heuristic(float(passInfo.y) * s.pdf, density);
        sum += (s.diffuseWeight * l.shares.x + s.specularWeight * l.shares.y) * radiance * weight;
    }
    return sum;
}

void main() {
    setPagePoint();
    uvec2 pixel = uvec2(gl_FragCoord.xy);
#ifdef PRESENCE
    vec3 passes;
    if (randomAt(pixel, uint(passInfo.x), 31u) >= materialPresence(passes)) discard;
#endif
    vec3 color = materialEmission(point.view);
    materialSetup();
    for (int i = 0; i < lightCount; ++i) {
        uint d = 64u + 2u * uint(i);
        color += fromLight(i, vec2(randomAt(pixel, uint(passInfo.x), d),
                                   randomAt(pixel, uint(passInfo.x), d + 1u)));
    }
    vec3 found = vec3(0.0);
    for (int i = 0; i < passInfo.y; ++i) {
        uint index = uint(passInfo.x * passInfo.y + i);
        vec3 u = vec3(randomAt(pixel, index, 0u), randomAt(pixel, index, 1u),
                      randomAt(pixel, index, 2u));
        MaterialSample s = materialSample(u, randomAt(pixel, index, 3u));
        if (s.event != 0) found += along(s);
    }
    color += found / float(max(passInfo.y, 1));
    // A value that is no number would stay in the mean for ever.
    if (any(isnan(color)) || any(isinf(color))) color = vec3(0.0);
    outColor = vec4(color, 1.0);
}

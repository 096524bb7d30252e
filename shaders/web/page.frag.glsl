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

// What a sample of the BSDF finds: the environment, and the lights that it meets. Diffuse and
// specular shares of the value, each over the density.
vec3 along(vec3 wi, vec3 diffuse, vec3 specular, float pdf, bool delta) {
    float apart = float(passInfo.z) * pdf * 4.0 * PI / environmentInfo.x;
    // Half as wide as the samples are apart: a filter reaches over two texels. More would blur.
    float lod = delta ? 0.0 : clamp(-0.5 * log2(max(apart, 1e-20)) - 1.0, 0.0, environmentInfo.y);
    vec3 sum = (diffuse + specular) * environmentAt(wi, lod);
    if (isBlocked(wi)) return sum;
    for (int i = 0; i < lightCount; ++i) {
        PageLight l = lightAt(i);
        float density;
        vec3 radiance = lightAlong(l, point.position, wi, density);
        if (density == 0.0) continue;
        float weight = delta ? 1.0 : heuristic(float(passInfo.y) * pdf, density);
        sum += (diffuse * l.shares.x + specular * l.shares.y) * radiance * weight;
    }
    return sum;
}

void main() {
    setPagePoint();
    vec2 pixel = floor(gl_FragCoord.xy);
#ifdef PRESENCE
    vec3 passes;
    if (randomAt(pixel, uint(passInfo.x), 7u) >= materialPresence(passes)) discard;
#endif
    vec3 color = materialEmission(point.view);
    materialSetup();
    float share = 1.0 / float(passInfo.y);
    // One loop over samples of lights and of the BSDF, so that the lobes stand in the text once.
    for (int i = 0; i < lightCount + passInfo.y; ++i) {
        bool ofLight = i < lightCount;
        MaterialSample s = materialSampleNone();
        PageLight l;
        vec3 radiance = vec3(0.0);
        float density = 0.0;
        if (ofLight) {
            uint d = 8u + 4u * uint(i);
            vec2 u = vec2(randomAt(pixel, uint(passInfo.x), d), randomAt(pixel, uint(passInfo.x), d + 1u));
            l = lightAt(i);
            radiance = sampleLight(l, point.position, u, s.wi, density);
            if (radiance == vec3(0.0) || isBlocked(s.wi)) continue;
        } else {
            uint index = uint(passInfo.x * passInfo.y + i - lightCount);
            vec3 u = vec3(randomAt(pixel, index, 0u), randomAt(pixel, index, 1u),
                          randomAt(pixel, index, 2u));
            s = materialSample(u, randomAt(pixel, index, 3u));
            if (s.event == 0) continue;
            if ((s.event & LOBE_DELTA) != 0) {
                color += along(s.wi, s.diffuseWeight, s.specularWeight, s.pdf, true) * share;
                continue;
            }
        }
        MaterialEval f = materialEvalBut(s.wi, ofLight ? -1 : drawnLobe);
        f.diffuse += s.diffuseWeight;
        f.specular += s.specularWeight;
        f.pdf += s.pdf;
        if (!ofLight) {
            float inverse = f.pdf > 0.0 ? share / f.pdf : 0.0;
            color += along(s.wi, f.diffuse * inverse, f.specular * inverse, f.pdf, false);
            continue;
        }
        float found = l.kind == LIGHT_CYLINDER ? 0.0 : float(passInfo.y) * f.pdf;
        float weight = density == 0.0 ? 1.0 : heuristic(density, found) / density;
        color += (f.diffuse * l.shares.x + f.specular * l.shares.y) * radiance * weight;
    }
    // A value that is no number would stay in the mean for ever.
    if (any(isnan(color)) || any(isinf(color))) color = vec3(0.0);
    outColor = vec4(color, 1.0);
}

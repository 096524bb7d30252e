// SPDX-License-Identifier: Apache-2.0
// Begins the fragment stage of everything that evaluates a material: the shading point.
#include "shaders/raster/triangles.glsl"
in vec3 vPosition;
in vec3 vObjectPosition;
in vec3 vNormal;
in vec2 vAcross;
flat in mat3 vNormalMatrix;
flat in float vScale;
flat in ivec4 vInstance; // id, row of links, bits of primvars that there are, place of the prim
#if PRIMVARS > 0
in vec4 vPrimvars[PRIMVARS];
#endif
// Of the triangle; world space.
vec3 vTangent;
vec3 vBitangent;
vec3 vGeometricNormal;
float vUvPerLength;
ivec4 vIds; // element, instance, row of links, place of the prim
flat in ivec4 drawInfo; // random numbers: what triangles are counted from; prim id; flags; first of Triangles

vec4 primvar(int slot, vec4 fallback) {
#if PRIMVARS > 0
    if (slot >= 0 && slot < PRIMVARS && (vInstance.z & (1 << slot)) != 0)
        return vPrimvars[slot];
#endif
    return fallback;
}

void loadTriangle() {
    Triangle t = triangles[drawInfo.w + gl_PrimitiveID];
    mat3 n = vNormalMatrix;
    vec3 ng = n * t.normal;
    vGeometricNormal = ng / max(length(ng), 1e-30);
    // Directions go by the inverse transpose of what normals go by.
    vec3 c0 = cross(n[1], n[2]);
    float determinant = dot(c0, n[0]);
    mat3 linear = mat3(c0, cross(n[2], n[0]), cross(n[0], n[1]));
    float scale = 1.0 / (abs(determinant) > 1e-37 ? determinant : 1e-37);
    vTangent = linear * t.dPdu * scale;
    vBitangent = linear * t.dPdv * scale;
    vUvPerLength = t.uvPerLength / max(vScale, 1e-20);
    vIds = ivec4(t.element, vInstance.xyw);
}

const int FACETED = 2;
const int TUBE = 4;
const int STRIP = 8;
const int CULLS_BACK = 16;
const int CULLS_FRONT = 32;
bool isTube() {
    return (drawInfo.z & (TUBE | STRIP)) != 0;
}
float tubeRadius = 0.0;

// At the outline of a tube a normal may turn away.
vec3 towardsViewer(vec3 normal, vec3 view) {
    float c = dot(normal, view);
    return c < 1e-3 ? normalize(normal + view * (1e-3 - c)) : normal;
}
// The near side of the tube that a strip stands for.
void setOnStrip(vec3 view) {
    vec3 along = unitOr(vNormal, vTangent);
    vec3 across = unitOr(cross(along, view), anyTangent(along));
    float h = clamp(vAcross.x, -1.0, 1.0);
    // Interpolated over parts of a pixel it is only as exact as corners are, which drivers round: below an
    // eighth of a pixel any place across is taken, which are all as likely.
    if (fwidth(vAcross.x) > 16.0) {
        uint id = uint(drawInfo.x + gl_PrimitiveID);
        uvec2 strip = uvec2(id & 1023u, id >> 22u);
        float there = 2.0 * randomAt(uvec2(gl_FragCoord.xy) + strip, uint(passIndex), 30u).x - 1.0;
        point.position += across * ((there - h) * tubeRadius);
        h = there;
    }
    float front = sqrt(1.0 - h * h) * tubeRadius;
    vec3 facing = cross(across, along);
    vec3 around = across * h + facing * sqrt(1.0 - h * h);
    float slope = triangles[drawInfo.w + gl_PrimitiveID].slope;
    point.normal = slope == 0.0 ? around : towardsViewer(normalize(around - along * slope), view);
    point.geometricNormal = point.normal;
    point.position += facing * (front - vAcross.y * tubeRadius);
    point.objectPosition += around * tubeRadius * vNormalMatrix;
    vTangent = along;
}

// A tube casts the shadow of a strip that faces the light, so its points are compared with the
// strip's plane, in front of which they all are on the lit side.
vec3 planeTowards(vec3 towards) {
    if (!isTube()) return point.geometricNormal;
    return unitOr(towards - point.tangent * dot(towards, point.tangent), vec3(0.0));
}
// Where light from wi comes in. Light through a fibre starts again on the far side, nearly; see
// SurfacePoint::departure() of the path tracer.
vec3 departure(vec3 wi) {
#ifdef MATERIAL_IS_FIBRE
    float cosine = dot(wi, point.geometricNormal), along = dot(wi, point.tangent);
    if (isTube() && cosine < 0.0) {
        float sin2 = max(1.0 - along * along, 0.01);
        float chord = -2.0 * tubeRadius * cosine / sin2;
        // Strips lie at the axes of fibres. Those that the far side is inside of shade it, too: half a circle's
        // area, as much as a strip covers that begins 0.785 radii before it. Never behind the own axis.
        float before = min(0.785 * tubeRadius * inversesqrt(sin2), 0.5 * chord);
        return point.position + wi * (chord - before + 0.05 * tubeRadius);
    }
#endif
    return point.position;
}

void setPoint(vec3 view, float coneWidth) {
    loadTriangle();
    point.position = vPosition;
    worldOrigin = passOrigin;
    point.objectPosition = vObjectPosition;
    point.geometricNormal = vGeometricNormal;
    point.view = view;
    tubeRadius = length(triangles[drawInfo.w + gl_PrimitiveID].dPdu) * vScale;
    if ((drawInfo.z & STRIP) != 0) {
        setOnStrip(view);
    } else {
        point.normal = (drawInfo.z & FACETED) != 0 ? vGeometricNormal : unitOr(vNormal, vGeometricNormal);
        if (dot(point.normal, point.geometricNormal) < 0.0) point.normal = -point.normal;
        if ((drawInfo.z & TUBE) != 0) point.normal = point.geometricNormal = towardsViewer(point.normal, view);
    }
    vec3 t = vTangent - point.normal * dot(point.normal, vTangent);
    float l = length(t);
    if (l > 1e-20) {
        point.tangent = t / l;
        vec3 across = cross(point.normal, point.tangent);
        point.bitangent = dot(across, vBitangent) < 0.0 ? -across : across;
    } else {
        point.tangent = anyTangent(point.normal);
        point.bitangent = cross(point.normal, point.tangent);
    }
    point.objectToWorldNormal = vNormalMatrix;
    float cosine = max(0.1, abs(dot(point.geometricNormal, view)));
    point.lengthPerUv = 1.0 / max(vUvPerLength, 1e-20);
    point.uvFootprint = vUvPerLength * coneWidth / sqrt(cosine);
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    point.seed = hash(pixel.x + hash(pixel.y + hash(uint(passIndex) + hash(uint(passSeed))))) | 1u;
}

void setPointFromCamera() {
    vec3 toEye = eye - vPosition;
    float distance = length(toEye);
    vec3 view = isPerspective != 0 ? toEye / max(distance, 1e-20) : -forward;
    setPoint(view, isPerspective != 0 ? pixelSpread * distance : pixelSpread);
#ifdef CULLS
    if ((drawInfo.z & (dot(point.geometricNormal, view) < 0.0 ? CULLS_BACK : CULLS_FRONT)) != 0) discard;
#endif
}

// Whether this pass shows the surface at all: presence as a chance (stochastic transparency).
// Numbers of one triangle in one pixel, so that what lies behind each other is drawn apart.
float ownRandom(uint set) {
    uint id = hash(uint(drawInfo.x + gl_PrimitiveID) + hash(uint(vInstance.x)));
    return randomAt(uvec2(gl_FragCoord.xy) + uvec2(id & 1023u, id >> 22u), uint(passIndex), set).x;
}
bool isPresent() {
    vec3 passes;
    return ownRandom(31u) < materialPresence(passes);
}

// SPDX-License-Identifier: Apache-2.0
// What the functions of pattern nodes (shaders/patterns/nodes) know of the place where they run, as GLSL; as C++ it
// is materialNetwork/nodes/patternFunctions.h. The types below stand for what a call has beside the inputs of its
// node. In GLSL most of them are constants.

#define NodeSize int        // components of the first input
#define NodeMode int        // what a string or uniform input selects
#define NodeTexture int     // one of the material's textures, -1 for none
#define NodeWavelength float // nm; 0 for light of no one wavelength
#define NodePrimvar vec4    // the primvar of the node; where there is none its next input,
#define NodePrimvarOrZero vec4  // or zeros,
#define NodePrimvarOrBlack vec4 // or opaque black

// World space, unit vectors; see materialNetwork/shadingPoint.h.
struct SurfacePoint {
    vec3 position;
    vec3 objectPosition;
    vec3 geometricNormal;
    vec3 normal;
    vec3 tangent;
    vec3 bitangent;
    vec3 view;
    mat3 objectToWorldNormal;
    float lengthPerUv;
    float uvFootprint;
    uint seed;
};
vec3 worldOrigin = vec3(0.0); // what positions are relative to

vec3 viewOf(SurfacePoint p) {
    return p.view;
}
vec3 worldPositionOf(SurfacePoint p) {
    return p.position + worldOrigin;
}

bool hasTexture(int map) {
    return map >= 0;
}
// Defined by the text of a material.
vec4 texel(int map, vec2 uv, float footprint);

// SPDX-License-Identifier: Apache-2.0
// UsdUVTexture of the UsdPreviewSurface specification.
#ifndef PATINA_NODE_ROWS

PATINA_FN float nodeUvTexture(vec2 uv, vec4 scale, vec4 bias, vec4 missing, NodeMode ends,
                              NodeTexture map, PATINA_IN(SurfacePoint) p, PATINA_OUT(float) g,
                              PATINA_OUT(float) b, PATINA_OUT(float) a, PATINA_OUT(vec3) rgb,
                              PATINA_OUT(vec4) rgba) {
    vec4 t = missing;
    if (hasTexture(map)) {
        t = mix(missing, texel(map, uv, p.uvFootprint), patternCover(uv, p.uvFootprint, ends));
        t = t * scale + bias;
    }
    g = t.y;
    b = t.z;
    a = t.w;
    rgb = vec3(t);
    rgba = t;
    return t.x;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

#define PATINA_UV_TEXTURE                                                                          \
    "filename file=, vector2 st=@UV0, vector4 scale=1, vector4 bias=0, vector4 fallback=0 0 0 1, "
#define PATINA_UV_OUTPUTS "float r, float g, float b, float a, color3 rgb, color4 rgba"

const NodeRow rows[] = {
    {"UsdUVTexture", "UsdUVTexture",
     PATINA_UV_TEXTURE "string wrapS=useMetadata, string wrapT=useMetadata, "
                       "string sourceColorSpace=auto",
     PATINA_UV_OUTPUTS, PATINA_PATTERN(nodeUvTexture), Algebra::None, nullptr, prepareUvTexture},
    {"ND_UsdUVTexture", "UsdUVTexture",
     PATINA_UV_TEXTURE "string wrapS=periodic, string wrapT=periodic, "
                       "string sourceColorSpace=auto",
     PATINA_UV_OUTPUTS, PATINA_PATTERN(nodeUvTexture), Algebra::None, nullptr, prepareUvTexture},
};

#endif

// SPDX-License-Identifier: Apache-2.0
// UsdUVTexture of the UsdPreviewSurface specification.

PATINA_FN float nodeUvTexture(vec2 uv, vec4 scale, vec4 bias, vec4 missing, NodeTexture map,
                              PATINA_IN(SurfacePoint) p, PATINA_OUT(float) g, PATINA_OUT(float) b,
                              PATINA_OUT(float) a, PATINA_OUT(vec3) rgb, PATINA_OUT(vec4) rgba) {
    vec4 t = missing;
    if (hasTexture(map)) t = texel(map, uv, p.uvFootprint) * scale + bias;
    g = t.y;
    b = t.z;
    a = t.w;
    rgb = vec3(t);
    rgba = t;
    return t.x;
}

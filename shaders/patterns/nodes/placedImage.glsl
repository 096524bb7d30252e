// SPDX-License-Identifier: Apache-2.0
// Image nodes that bring their own placement: glTF's, latitude-longitude maps, three planes.
#ifndef PATINA_NODE_ROWS

// glTF's own transform turns the other way round about the upper left corner.
PATINA_FN_RARE vec4 gltfTexel(vec4 missing, vec2 uv, vec2 pivot, vec2 scale, float rotate,
                              vec2 offset, int order, NodeMode ends, NodeTexture map,
                              PATINA_IN(SurfacePoint) p) {
    if (!hasTexture(map)) return missing;
    vec2 inverseScale =
        vec2(scale.x != 0.0f ? 1.0f / scale.x : 0.0f, scale.y != 0.0f ? 1.0f / scale.y : 0.0f);
    vec2 at = patternPlace2d(uv, pivot, inverseScale, -rotate, vec2(-offset.x, offset.y), order);
    float width = p.uvFootprint * max(abs(scale.x), abs(scale.y));
    return mix(missing, texel(map, at, width), patternCover(at, width, ends));
}
PATINA_FN vec4 nodeGltfImage(vec4 missing, vec2 uv, vec2 pivot, vec2 scale, float rotate,
                             vec2 offset, int order, vec4 factor, NodeMode ends, NodeTexture map,
                             PATINA_IN(SurfacePoint) p) {
    return gltfTexel(missing, uv, pivot, scale, rotate, offset, order, ends, map, p) * factor;
}
PATINA_FN float nodeGltfScalarImage(float missing, vec2 uv, vec2 pivot, vec2 scale, float rotate,
                                    vec2 offset, int order, float factor, NodeMode ends,
                                    NodeTexture map, PATINA_IN(SurfacePoint) p) {
    return gltfTexel(vec4(missing), uv, pivot, scale, rotate, offset, order, ends, map, p).x *
           factor;
}
PATINA_FN vec4 nodeGltfColorImage(vec4 missing, vec2 uv, vec2 pivot, vec2 scale, float rotate,
                                  vec2 offset, PATINA_UNUSED(int, order), vec4 color,
                                  vec4 geomColor, NodeMode ends, NodeTexture map,
                                  PATINA_IN(SurfacePoint) p, PATINA_OUT(float) alpha) {
    vec4 t =
        gltfTexel(missing, uv, pivot, scale, rotate, offset, 0, ends, map, p) * color * geomColor;
    alpha = t.w;
    return t;
}
PATINA_FN vec3 nodeGltfNormalMap(vec4 missing, vec2 uv, vec2 pivot, vec2 scale, float rotate,
                                 vec2 offset, int order, vec3 n, vec3 t, vec3 b, NodeMode ends,
                                 NodeTexture map, PATINA_IN(SurfacePoint) p) {
    return patternNormalMap(
        vec3(gltfTexel(missing, uv, pivot, scale, rotate, offset, order, ends, map, p)), vec2(1.0f),
        n, t, b);
}
// Black texels are the thickest, as MaterialX has it.
PATINA_FN float nodeGltfThickness(vec4 missing, vec2 uv, vec2 pivot, vec2 scale, float rotate,
                                  vec2 offset, PATINA_UNUSED(int, order), float least, float most,
                                  NodeMode ends, NodeTexture map, PATINA_IN(SurfacePoint) p) {
    vec4 t = gltfTexel(missing, uv, pivot, scale, rotate, offset, 0, ends, map, p);
    return most + (least - most) * t.y;
}
PATINA_FN float nodeGltfAnisotropy(vec4 missing, vec2 uv, vec2 pivot, vec2 scale, float rotate,
                                   vec2 offset, PATINA_UNUSED(int, order), float strength,
                                   float rotation, NodeMode ends, NodeTexture map,
                                   PATINA_IN(SurfacePoint) p, PATINA_OUT(float) turned) {
    vec4 t = gltfTexel(missing, uv, pivot, scale, rotate, offset, 0, ends, map, p);
    turned = rotation + atan(t.y * 2.0f - 1.0f, t.x * 2.0f - 1.0f);
    return strength * t.z;
}

// rotation: degrees.
PATINA_FN vec4 nodeLatLongImage(vec4 missing, vec3 d, float rotation, NodeMode ends,
                                NodeTexture map) {
    if (!hasTexture(map)) return missing;
    vec2 at = vec2(atan(d.x, d.z) * -0.15915494f + 0.5f + rotation / 360.0f,
                   arcsine(d.y) * 0.31830989f + 0.5f);
    return mix(missing, texel(map, at, 0.0f), patternCover(at, 0.0f, ends));
}

PATINA_FN vec4 planeTexel(vec4 missing, NodeTexture map, vec2 uv, float footprint) {
    return hasTexture(map) ? texel(map, uv, footprint) : missing;
}
PATINA_FN vec4 nodeTriplanar(vec4 missing, vec3 at, vec3 normal, int up, float blend,
                             NodeTexture mapX, NodeTexture mapY, NodeTexture mapZ,
                             PATINA_IN(SurfacePoint) p) {
    vec3 w = abs(normal);
    float sum = w.x + w.y + w.z;
    if (!(sum > 0.0f)) return missing;
    float sharpness = 1.0f / clamp(blend, 0.03f, 1.0f);
    w = vec3(pow(w.x / sum, sharpness), pow(w.y / sum, sharpness), pow(w.z / sum, sharpness));
    float total = w.x + w.y + w.z;
    if (!(total > 0.0f)) return missing;
    vec2 x = up == 2 ? vec2(at.y, at.z) : vec2(at.z, at.y);
    vec2 y = up == 0 ? vec2(at.z, at.x) : vec2(at.x, at.z);
    vec2 z = up == 0 ? vec2(-at.y, at.x) : vec2(at.x, at.y);
    float width = p.uvFootprint * p.lengthPerUv;
    vec4 t = vec4(0.0f);
    if (w.x > 0.0f) t += planeTexel(missing, mapX, x, width) * (w.x / total);
    if (w.y > 0.0f) t += planeTexel(missing, mapY, y, width) * (w.y / total);
    if (w.z > 0.0f) t += planeTexel(missing, mapZ, z, width) * (w.z / total);
    return t;
}
PATINA_FN float nodeScalarTriplanar(float missing, vec3 at, vec3 normal, int up, float blend,
                                    NodeTexture mapX, NodeTexture mapY, NodeTexture mapZ,
                                    PATINA_IN(SurfacePoint) p) {
    return nodeTriplanar(vec4(missing), at, normal, up, blend, mapX, mapY, mapZ, p).x;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

#define PATINA_ADDRESS                                                                             \
    "string uaddressmode=periodic, string vaddressmode=periodic, string filtertype=linear"
#define PATINA_GLTF(type, missing)                                                                 \
    "filename file=, " type " default=" missing ", vector2 texcoord=@UV0, vector2 pivot=0 1, "     \
    "vector2 scale=1, float rotate=0, vector2 offset=0, integer operationorder="
#define PATINA_FRAME "vector3 normal=@Nworld, vector3 tangent=@Tworld, vector3 bitangent=@Bworld, "
#define PATINA_TRIPLANAR                                                                           \
    "filename filex=, filename filey=, filename filez=, $ default=0, vector3 position=@Pobject, "  \
    "vector3 normal=@Nobject, integer upaxis=2, float blend=1, string layerx=, string layery=, "   \
    "string layerz=, string filtertype=linear, string framerange=, integer frameoffset=0, "        \
    "string frameendaction=constant"
constexpr Algebra none = Algebra::None;

const NodeRow rows[] = {
    {"ND_gltf_image_$_$_1_0", "gltf_image", PATINA_GLTF("$", "0") "0, $ factor=1, " PATINA_ADDRESS,
     "$", PATINA_PATTERN(nodeGltfImage), none, "color3 vector3", prepareImage},
    {"ND_gltf_image_color4_color4_1_0", "gltf_image",
     PATINA_GLTF("color4", "0") "1, color4 factor=1, " PATINA_ADDRESS, "color4",
     PATINA_PATTERN(nodeGltfImage), none, nullptr, prepareImage},
    {"ND_gltf_image_float_float_1_0", "gltf_image",
     PATINA_GLTF("float", "0") "0, float factor=1, " PATINA_ADDRESS, "float",
     PATINA_PATTERN(nodeGltfScalarImage), none, nullptr, prepareImage},
    {"ND_gltf_colorimage", "gltf_colorimage",
     PATINA_GLTF("color4", "0") "1, color4 color=1, color4 geomcolor=1, " PATINA_ADDRESS,
     "color3 outcolor, float outa", PATINA_PATTERN(nodeGltfColorImage), none, nullptr,
     prepareImage},
    {"ND_gltf_normalmap_vector3_1_0", "gltf_normalmap",
     PATINA_GLTF("vector3", "0.5 0.5 1") "0, " PATINA_FRAME PATINA_ADDRESS, "vector3",
     PATINA_PATTERN(nodeGltfNormalMap), none, nullptr, prepareImage},
    {"ND_gltf_iridescence_thickness_float_1_0", "gltf_iridescence_thickness",
     "filename file=, vector3 default=0, vector2 texcoord=@UV0, vector2 pivot=0, vector2 scale=1, "
     "float rotate=0, vector2 offset=0, integer operationorder=0, float thicknessMin=100, "
     "float thicknessMax=400, " PATINA_ADDRESS,
     "float", PATINA_PATTERN(nodeGltfThickness), none, nullptr, prepareImage},
    {"ND_gltf_anisotropy_image", "gltf_anisotropy_image",
     PATINA_GLTF("vector3", "1 0.5 1") "0, float anisotropy_strength=1, "
                                       "float anisotropy_rotation=0, " PATINA_ADDRESS,
     "float anisotropy_strength_out, float anisotropy_rotation_out",
     PATINA_PATTERN(nodeGltfAnisotropy), none, nullptr, prepareImage},
    {"ND_latlongimage", "latlongimage",
     "filename file=, color3 default=0, vector3 viewdir=0 0 1, float rotation=0, "
     "string vaddressmode=mirror",
     "color3", PATINA_PATTERN(nodeLatLongImage), none, nullptr, prepareImage},
    {"ND_triplanarprojection_$", "triplanarprojection", PATINA_TRIPLANAR, "$",
     PATINA_PATTERN(nodeScalarTriplanar), none, "float", prepareTriplanar},
    {"ND_triplanarprojection_$", "triplanarprojection", PATINA_TRIPLANAR, "$",
     PATINA_PATTERN(nodeTriplanar), none, tupleTypes, prepareTriplanar},
};

#endif

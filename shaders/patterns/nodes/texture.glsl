// SPDX-License-Identifier: Apache-2.0
// MaterialX image nodes.
#ifndef PATINA_NODE_ROWS

PATINA_FN vec4 nodeImage(vec4 missing, vec2 uv, NodeMode ends, NodeTexture map,
                         PATINA_IN(SurfacePoint) p) {
    if (!hasTexture(map)) return missing;
    return mix(missing, texel(map, uv, p.uvFootprint), patternCover(uv, p.uvFootprint, ends));
}
PATINA_FN float nodeScalarImage(float missing, vec2 uv, NodeMode ends, NodeTexture map,
                                PATINA_IN(SurfacePoint) p) {
    return nodeImage(vec4(missing), uv, ends, map, p).x;
}

PATINA_FN vec4 nodeTiledImage(vec4 missing, vec2 uv, vec2 tiling, vec2 offset, vec2 imageSize,
                              vec2 tileSize, NodeMode ends, NodeTexture map,
                              PATINA_IN(SurfacePoint) p) {
    if (!hasTexture(map)) return missing;
    vec2 t = uv * tiling - offset;
    vec2 at = vec2(imageSize.x != 0.0f ? t.x / imageSize.x * tileSize.x : 0.0f,
                   imageSize.y != 0.0f ? t.y / imageSize.y * tileSize.y : 0.0f);
    float width = p.uvFootprint * max(abs(tiling.x), abs(tiling.y));
    return mix(missing, texel(map, at, width), patternCover(at, width, ends));
}
PATINA_FN float nodeScalarTiledImage(float missing, vec2 uv, vec2 tiling, vec2 offset,
                                     vec2 imageSize, vec2 tileSize, NodeMode ends, NodeTexture map,
                                     PATINA_IN(SurfacePoint) p) {
    return nodeTiledImage(vec4(missing), uv, tiling, offset, imageSize, tileSize, ends, map, p).x;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

#define PATINA_IMAGE "filename file=, $ default=0, vector2 texcoord=@UV0, "
#define PATINA_ADDRESS                                                                             \
    "string uaddressmode=periodic, string vaddressmode=periodic, string filtertype=linear"
// Sequences and layers of images are not read; the inputs are known so that documents may have
// them.
#define PATINA_FRAMES                                                                              \
    ", string layer=, string framerange=, integer frameoffset=0, string frameendaction=constant"
#define PATINA_TILED                                                                               \
    PATINA_IMAGE "vector2 uvtiling=1, vector2 uvoffset=0, vector2 realworldimagesize=1, "          \
                 "vector2 realworldtilesize=1, string filtertype=linear, "                         \
                 "string uaddressmode=periodic, string vaddressmode=periodic" PATINA_FRAMES

const NodeRow rows[] = {
    {"ND_image_float", "image",
     "filename file=, float default=0, vector2 texcoord=@UV0, " PATINA_ADDRESS PATINA_FRAMES,
     "float", PATINA_PATTERN(nodeScalarImage), Algebra::None, nullptr, prepareImage},
    {"ND_image_$", "image", PATINA_IMAGE PATINA_ADDRESS PATINA_FRAMES, "$",
     PATINA_PATTERN(nodeImage), Algebra::None, tupleTypes, prepareImage},
    {"ND_tiledimage_$", "tiledimage", PATINA_TILED, "$", PATINA_PATTERN(nodeScalarTiledImage),
     Algebra::None, "float", prepareImage},
    {"ND_tiledimage_$", "tiledimage", PATINA_TILED, "$", PATINA_PATTERN(nodeTiledImage),
     Algebra::None, tupleTypes, prepareImage},
};

#endif

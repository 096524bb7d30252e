// SPDX-License-Identifier: Apache-2.0
// MaterialX image nodes.

PATINA_FN vec4 nodeImage(vec4 missing, vec2 uv, NodeTexture map, PATINA_IN(SurfacePoint) p) {
    return hasTexture(map) ? texel(map, uv, p.uvFootprint) : missing;
}
PATINA_FN float nodeScalarImage(float missing, vec2 uv, NodeTexture map,
                                PATINA_IN(SurfacePoint) p) {
    return nodeImage(vec4(missing), uv, map, p).x;
}

PATINA_FN vec4 nodeTiledImage(vec4 missing, vec2 uv, vec2 tiling, vec2 offset, vec2 imageSize,
                              vec2 tileSize, NodeTexture map, PATINA_IN(SurfacePoint) p) {
    if (!hasTexture(map)) return missing;
    vec2 t = uv * tiling - offset;
    vec2 at = vec2(imageSize.x != 0.0f ? t.x / imageSize.x * tileSize.x : 0.0f,
                   imageSize.y != 0.0f ? t.y / imageSize.y * tileSize.y : 0.0f);
    return texel(map, at, p.uvFootprint * max(abs(tiling.x), abs(tiling.y)));
}
PATINA_FN float nodeScalarTiledImage(float missing, vec2 uv, vec2 tiling, vec2 offset,
                                     vec2 imageSize, vec2 tileSize, NodeTexture map,
                                     PATINA_IN(SurfacePoint) p) {
    return nodeTiledImage(vec4(missing), uv, tiling, offset, imageSize, tileSize, map, p).x;
}

// SPDX-License-Identifier: Apache-2.0
// Hex-tiled images: a texture repeated without visible repetition.
#ifndef PATINA_NODE_ROWS

PATINA_FN HexTiles tilesAt(vec2 uv, vec2 tiling, float rotation, vec2 rotationRange, float scale,
                           vec2 scaleRange, float offset, vec2 offsetRange) {
    HexSpread spread;
    spread.rotation = rotation;
    spread.rotationRange = rotationRange;
    spread.scale = scale;
    spread.scaleRange = scaleRange;
    spread.offset = offset;
    spread.offsetRange = offsetRange;
    return hexTiles(uv * tiling, spread);
}
PATINA_FN vec4 tileTexel(NodeTexture map, HexTile tile, vec2 tiling, PATINA_IN(SurfacePoint) p) {
    return texel(map, tile.uv,
                 p.uvFootprint * max(abs(tiling.x), abs(tiling.y)) / max(abs(tile.scale), 1e-6f));
}

PATINA_FN vec4 nodeHexImage(vec4 missing, vec2 uv, vec2 tiling, float rotation, vec2 rotationRange,
                            float scale, vec2 scaleRange, float offset, vec2 offsetRange,
                            float falloff, float contrast, vec3 luma, NodeTexture map,
                            PATINA_IN(SurfacePoint) p) {
    if (!hasTexture(map)) return missing;
    HexTiles tiles =
        tilesAt(uv, tiling, rotation, rotationRange, scale, scaleRange, offset, offsetRange);
    vec4 a = tileTexel(map, tiles.a, tiling, p);
    vec4 b = tileTexel(map, tiles.b, tiling, p);
    vec4 c = tileTexel(map, tiles.c, tiling, p);
    vec3 luminance = vec3(dot(vec3(a), luma), dot(vec3(b), luma), dot(vec3(c), luma));
    vec3 w = hexShares(tiles, vec3(1.0f) + (luminance - 1.0f) * contrast, falloff);
    vec3 even = hexShares(tiles, vec3(1.0f), falloff);
    return vec4(vec3(a) * w.x + vec3(b) * w.y + vec3(c) * w.z,
                a.w * even.x + b.w * even.y + c.w * even.z);
}

PATINA_FN vec3 turnedAbout(vec3 n, vec3 v, float s, float k) {
    return v * k + cross(n, v) * s + n * (dot(n, v) * (1.0f - k));
}
// The normal that a tile's texel stands for; its tangents turn with the tile.
PATINA_FN vec3 tileNormal(vec3 encoded, float angle, float strength, bool flips, vec3 n, vec3 t,
                          vec3 b) {
    vec3 m = encoded;
    if (flips) m.y = 1.0f - m.y;
    m = m * 2.0f - 1.0f;
    float s = sin(-angle);
    float k = cos(-angle);
    vec3 bent =
        (turnedAbout(n, t, s, k) * m.x + turnedAbout(n, b, s, k) * m.y) * strength + n * m.z;
    float l = length(bent);
    return l > 0.0f ? bent / l : n;
}
PATINA_FN vec3 nodeHexNormalMap(PATINA_UNUSED(vec3, missing), vec2 uv, vec2 tiling, float rotation,
                                vec2 rotationRange, float scale, vec2 scaleRange, float offset,
                                vec2 offsetRange, float falloff, float strength, bool flips, vec3 n,
                                vec3 t, vec3 b, NodeTexture map, PATINA_IN(SurfacePoint) p) {
    if (!hasTexture(map)) return n;
    HexTiles tiles =
        tilesAt(uv, tiling, rotation, rotationRange, scale, scaleRange, offset, offsetRange);
    vec3 w = hexShares(tiles, vec3(1.0f), falloff);
    vec3 x = tileNormal(vec3(tileTexel(map, tiles.a, tiling, p)), tiles.a.angle, strength, flips, n,
                        t, b);
    vec3 y = tileNormal(vec3(tileTexel(map, tiles.b, tiling, p)), tiles.b.angle, strength, flips, n,
                        t, b);
    vec3 z = tileNormal(vec3(tileTexel(map, tiles.c, tiling, p)), tiles.c.angle, strength, flips, n,
                        t, b);
    vec3 bent =
        n - (normalGradient(n, x) * w.x + normalGradient(n, y) * w.y + normalGradient(n, z) * w.z);
    float l = length(bent);
    return l > 0.0f && isFinite(l) ? bent / l : n;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

#define PATINA_HEX                                                                                 \
    "vector2 texcoord=@UV0, vector2 tiling=1, float rotation=1, vector2 rotationrange=0 360, "     \
    "float scale=1, vector2 scalerange=0.5 2, float offset=1, vector2 offsetrange=0 1, "           \
    "float falloff=0.5, "

const NodeRow rows[] = {
    {"ND_hextiledimage_$", "hextiledimage",
     "filename file=, $ default=0, " PATINA_HEX
     "float falloffcontrast=0.5, color3 lumacoeffs=0.2722287 0.6740818 0.0536895",
     "$", PATINA_PATTERN(nodeHexImage), Algebra::None, "color3 color4", prepareImage},
    {"ND_hextilednormalmap_vector3", "hextilednormalmap",
     "filename file=, vector3 default=0.5 0.5 1, " PATINA_HEX
     "float strength=1, boolean flip_g=0, vector3 normal=@Nworld, vector3 tangent=@Tworld, "
     "vector3 bitangent=@Bworld",
     "vector3", PATINA_PATTERN(nodeHexNormalMap), Algebra::None, nullptr, prepareImage},
};

#endif

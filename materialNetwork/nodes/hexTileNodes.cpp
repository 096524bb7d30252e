// SPDX-License-Identifier: Apache-2.0
// Hex-tiled images: a texture repeated without visible repetition.
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

/// Inputs (file, default, texcoord, tiling, rotation, rotationrange, scale, scalerange, offset,
/// offsetrange, falloff, ...).
sh::HexTiles tilesOf(Call c) {
    sh::HexSpread spread;
    spread.rotation = c.x(4);
    spread.rotationRange = vec2(c.in(5));
    spread.scale = c.x(6);
    spread.scaleRange = vec2(c.in(7));
    spread.offset = c.x(8);
    spread.offsetRange = vec2(c.in(9));
    return sh::hexTiles(vec2(c.in(2)) * vec2(c.in(3)), spread);
}

vec4 texel(Call c, const sh::HexTile& tile) {
    const float tiling = std::fmax(std::fabs(c.in(3).x), std::fabs(c.in(3).y));
    const float scale = std::fmax(std::fabs(tile.scale), 1e-6f);
    return c.context.textures->sample(c.data.handle, tile.uv,
                                      c.point().uvFootprint * tiling / scale);
}

/// Further inputs (falloffcontrast, lumacoeffs).
constexpr char hexImageGlsl[] =
    "(nodeHexSet($2, $3, $4.x, $5, $6.x, $7, $8.x, $9), nodeHexImage($t(nodeHex.a.uv, "
    "nodeHexFootprint(nodeHex.a, $3)), $t(nodeHex.b.uv, nodeHexFootprint(nodeHex.b, "
    "$3)), $t(nodeHex.c.uv, nodeHexFootprint(nodeHex.c, $3)), ${10}.x, ${11}.x, "
    "${12}.xyz))";
constexpr Pattern hexImage = rarePattern(hexImageGlsl, "$1", [](Call c) {
    if (c.data.handle < 0) {
        c.out() = c.in(1);
        return;
    }
    const sh::HexTiles tiles = tilesOf(c);
    const vec4 a = texel(c, tiles.a), b = texel(c, tiles.b), d = texel(c, tiles.c);
    const vec3 luma(c.in(12));
    const vec3 luminance(glm::dot(vec3(a), luma), glm::dot(vec3(b), luma), glm::dot(vec3(d), luma));
    const vec3 w = sh::hexShares(tiles, vec3(1.0f) + (luminance - 1.0f) * c.x(11), c.x(10));
    const vec3 even = sh::hexShares(tiles, vec3(1.0f), c.x(10));
    c.out() = vec4(vec3(a) * w.x + vec3(b) * w.y + vec3(d) * w.z,
                   a.w * even.x + b.w * even.y + d.w * even.z);
});

/// The normal that a tile's texel stands for; its tangents turn with the tile.
vec3 tileNormal(Call c, const sh::HexTile& tile) {
    vec3 m(texel(c, tile));
    if (c.x(12) != 0.0f) m.y = 1.0f - m.y;
    m = m * 2.0f - 1.0f;
    const vec3 n(c.in(13)), t(c.in(14)), b(c.in(15));
    const float s = std::sin(-tile.angle), k = std::cos(-tile.angle);
    const auto turned = [&](const vec3& v) {
        return v * k + glm::cross(n, v) * s + n * (glm::dot(n, v) * (1.0f - k));
    };
    const vec3 bent = (turned(t) * m.x + turned(b) * m.y) * c.x(11) + n * m.z;
    const float length = glm::length(bent);
    return length > 0.0f ? bent / length : n;
}

/// Further inputs (strength, flip_g, normal, tangent, bitangent).
constexpr char hexNormalMapGlsl[] =
    "(nodeHexSet($2, $3, $4.x, $5, $6.x, $7, $8.x, $9), nodeHexNormal($t(nodeHex.a.uv, "
    "nodeHexFootprint(nodeHex.a, $3)), $t(nodeHex.b.uv, nodeHexFootprint(nodeHex.b, "
    "$3)), $t(nodeHex.c.uv, nodeHexFootprint(nodeHex.c, $3)), ${10}.x, ${11}.x, ${12}.x, "
    "${13}.xyz, ${14}.xyz, ${15}.xyz))";
constexpr Pattern hexNormalMap = rarePattern(hexNormalMapGlsl, "vec4(${13}.xyz, 0.0)", [](Call c) {
    const vec3 n(c.in(13));
    c.out() = vec4(n, 0.0f);
    if (c.data.handle < 0) return;
    const sh::HexTiles tiles = tilesOf(c);
    const vec3 w = sh::hexShares(tiles, vec3(1.0f), c.x(10));
    const vec3 bent = n - (sh::normalGradient(n, tileNormal(c, tiles.a)) * w.x +
                           sh::normalGradient(n, tileNormal(c, tiles.b)) * w.y +
                           sh::normalGradient(n, tileNormal(c, tiles.c)) * w.z);
    const float length = glm::length(bent);
    if (length > 0.0f && std::isfinite(length)) c.out() = vec4(bent / length, 0.0f);
});

#define PATINA_HEX                                                                                 \
    "vector2 texcoord=@UV0, vector2 tiling=1, float rotation=1, vector2 rotationrange=0 360, "     \
    "float scale=1, vector2 scalerange=0.5 2, float offset=1, vector2 offsetrange=0 1, "           \
    "float falloff=0.5, "

const NodeRow rows[] = {
    {"ND_hextiledimage_$", "hextiledimage",
     "filename file=, $ default=0, " PATINA_HEX
     "float falloffcontrast=0.5, color3 lumacoeffs=0.2722287 0.6740818 0.0536895",
     "$", hexImage, Algebra::None, "color3 color4", prepareImage, true},
    {"ND_hextilednormalmap_vector3", "hextilednormalmap",
     "filename file=, vector3 default=0.5 0.5 1, " PATINA_HEX
     "float strength=1, boolean flip_g=0, vector3 normal=@Nworld, vector3 tangent=@Tworld, "
     "vector3 bitangent=@Bworld",
     "vector3", hexNormalMap, Algebra::None, nullptr, prepareImage, true},
};

} // namespace

NodeRows hexTileNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina

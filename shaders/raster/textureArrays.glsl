// SPDX-License-Identifier: Apache-2.0
// Textures that are layers of an array: UDIM tiles, and those that have no unit of their own.
// As hdDelegate/image/textureSystem.cpp.
vec4 nodeLayerAt(sampler2DArray s, vec2 uv, float footprint, int layer) {
    ivec3 size = textureSize(s, 0);
    float lambda = log2(max(footprint * float(max(size.x, size.y)), 1e-6));
    return textureLod(s, vec3(uv, float(layer)), lambda);
}

// Layer of the tile whose corner this is; -1 for none. table: of addTable(), glslTextures.cpp.
int tileLayer(vec2 corner, int table) {
    float places = materialParameter(table).x;
    if (!(corner.x >= 0.0 && corner.x < 10.0 && corner.y >= 0.0 && corner.x + 10.0 * corner.y < places))
        return -1;
    int place = int(corner.x) + 10 * int(corner.y);
    return int(materialParameter(table + 1 + place / 4)[place % 4]);
}
// The far edge of a tile belongs to it when there is no next one.
vec4 nodeTiles(sampler2DArray s, vec2 uv, float footprint, int table) {
    if (any(isnan(uv)) || any(isinf(uv))) uv = vec2(0.0);
    vec2 corner = floor(uv);
    vec2 local = uv - corner;
    int layer = tileLayer(corner, table);
    for (int edge = 1; layer < 0 && edge < 4; ++edge) {
        vec2 back = vec2(float(edge & 1), float(edge >> 1));
        if ((back.x != 0.0 && local.x != 0.0) || (back.y != 0.0 && local.y != 0.0)) continue;
        layer = tileLayer(corner - back, table);
        if (layer >= 0) local += back;
    }
    if (layer < 0) return vec4(1.0, 0.0, 1.0, 1.0);
    return nodeLayerAt(s, local, footprint, layer);
}

// wrap: TextureWrap of materialNetwork/textureSource.h. The sampler clamps to the edge.
float wrapped(float x, int wrap, out bool inside) {
    inside = wrap != 0 || (x >= 0.0 && x <= 1.0);
    if (wrap < 2) return clamp(x, 0.0, 1.0);
    float t = x - floor(x);
    if (wrap == 2) return t;
    return (int(mod(floor(x), 2.0)) == 0) ? t : 1.0 - t;
}
vec4 nodeLayer(sampler2DArray s, vec2 uv, float footprint, int layer, int wrapS, int wrapT) {
    if (any(isnan(uv)) || any(isinf(uv))) uv = vec2(0.0);
    bool insideS, insideT;
    vec2 at = vec2(wrapped(uv.x, wrapS, insideS), wrapped(uv.y, wrapT, insideT));
    return insideS && insideT ? nodeLayerAt(s, at, footprint, layer) : vec4(0.0);
}

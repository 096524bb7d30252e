// SPDX-License-Identifier: Apache-2.0
// Hex tiling after Mikkelsen 2022, "Practical Real-Time Hex-Tiling" (JCGT 11.2), as MaterialX 1.39
// parameterises it: the plane is cut into hexagons, each reads the texture at its own rotation,
// scale and offset, and three are blended at every point.

// One of the three tiles that meet at a point. uv: where it reads the texture. weight: barycentric.
// angle: of its rotation, radians. scale: of its texture.
struct HexTile {
    vec2 uv;
    float weight;
    float angle;
    float scale;
};

struct HexTiles {
    HexTile a;
    HexTile b;
    HexTile c;
};

// Spread of rotation (degrees), scale and offset, and how much of each is used.
struct HexSpread {
    float rotation;
    vec2 rotationRange;
    float scale;
    vec2 scaleRange;
    float offset;
    vec2 offsetRange;
};

PATINA_FN float hexFract(float x) {
    return x - floor(x);
}

// Two random numbers for a hexagon; the sine-free hash that MaterialX uses here (Hoskins 2014).
PATINA_FN vec2 hexHash(vec2 p) {
    vec3 q = vec3(hexFract(p.x * 0.1031f), hexFract(p.y * 0.1030f), hexFract(p.x * 0.0973f));
    float d = dot(q, vec3(q.y + 33.33f, q.z + 33.33f, q.x + 33.33f));
    q = q + vec3(d);
    return vec2(hexFract((q.x + q.y) * q.z), hexFract((q.x + q.z) * q.y));
}

// vertex: of the skewed lattice.
PATINA_FN HexTile hexTile(vec2 uv, vec2 vertex, float weight, HexSpread spread) {
    vec2 lattice = vertex * (1.0f / 3.46410162f);
    vec2 centre = vec2(lattice.x + 0.5f * lattice.y, lattice.y * (1.0f / 1.15470054f));
    vec2 u = hexHash(vertex + vec2(0.12345f, 0.12345f));
    HexTile tile;
    tile.weight = weight;
    tile.angle =
        mix(spread.rotationRange.x, spread.rotationRange.y, u.x * spread.rotation) * (PI / 180.0f);
    tile.scale = mix(1.0f, mix(spread.scaleRange.x, spread.scaleRange.y, u.y), spread.scale);
    vec2 offset = vec2(mix(spread.offsetRange.x, spread.offsetRange.y, u.x * spread.offset),
                       mix(spread.offsetRange.x, spread.offsetRange.y, u.y * spread.offset));
    vec2 d = uv - centre;
    float s = sin(tile.angle);
    float c = cos(tile.angle);
    float inverse = 1.0f / select(tile.scale, 1.0f, abs(tile.scale) > 1e-12f);
    tile.uv = vec2(d.x * c - d.y * s, d.x * s + d.y * c) * inverse + centre + offset;
    return tile;
}

PATINA_FN HexTiles hexTiles(vec2 uv, HexSpread spread) {
    vec2 st = uv * 3.46410162f;
    // To the lattice in which every square is two triangles.
    vec2 skewed = vec2(st.x - 0.57735027f * st.y, 1.15470054f * st.y);
    vec2 base = vec2(floor(skewed.x), floor(skewed.y));
    vec2 f = skewed - base;
    float rest = 1.0f - f.x - f.y;
    float upper = select(1.0f, 0.0f, rest <= 0.0f);
    float turn = 2.0f * upper - 1.0f;
    HexTiles tiles;
    tiles.a = hexTile(uv, base + vec2(upper, upper), -rest * turn, spread);
    tiles.b = hexTile(uv, base + vec2(upper, 1.0f - upper), upper - f.y * turn, spread);
    tiles.c = hexTile(uv, base + vec2(1.0f - upper, upper), upper - f.x * turn, spread);
    return tiles;
}

// Schlick 1994, "Fast alternatives to Perlin's bias and gain functions" (Graphics Gems IV).
PATINA_FN float schlickGain(float x, float gain) {
    float a = (1.0f / clamp(gain, 0.001f, 0.999f) - 2.0f) * (1.0f - 2.0f * x);
    return select(x / (a + 1.0f), (a - x) / (a - 1.0f), x < 0.5f);
}

// Shares of the tiles. luminance: of the three texels, as far as contrast shall count.
// falloff: 0.5 is neutral, less makes the borders softer.
PATINA_FN vec3 hexShares(HexTiles tiles, vec3 luminance, float falloff) {
    vec3 w =
        luminance * vec3(pow(max(tiles.a.weight, 0.0f), 7.0f), pow(max(tiles.b.weight, 0.0f), 7.0f),
                         pow(max(tiles.c.weight, 0.0f), 7.0f));
    float sum = w.x + w.y + w.z;
    w = select(w / max(sum, 1e-30f), vec3(1.0f / 3.0f), sum > 1e-30f);
    vec3 g = vec3(schlickGain(w.x, falloff), schlickGain(w.y, falloff), schlickGain(w.z, falloff));
    g = g / max(g.x + g.y + g.z, 1e-30f);
    return select(w, g, falloff == 0.5f);
}

// The gradient of a height field that a normal stands for, seen from n (Mikkelsen 2020, "Surface
// gradient-based bump mapping framework").
PATINA_FN vec3 normalGradient(vec3 n, vec3 m) {
    float d = dot(n, m);
    return (n * d - m) / max(1e-6f, abs(d));
}

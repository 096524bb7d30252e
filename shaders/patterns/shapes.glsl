// SPDX-License-Identifier: Apache-2.0
// Shapes and tilings of the plane, after MaterialX 1.39. All give 0 or 1; nothing is antialiased
// here, which a renderer that takes several samples per pixel does anyway.

PATINA_FN float patternModulo(float a, float b) {
    return a - b * floor(a / b);
}

PATINA_FN float patternCircle(vec2 p, float radius) {
    return select(0.0f, 1.0f, dot(p, p) > radius * radius);
}

// A line from a to b with round ends. 0 lengths make a dot.
PATINA_FN float patternLine(vec2 p, vec2 a, vec2 b, float radius) {
    vec2 along = b - a;
    vec2 q = p - a;
    float l2 = dot(along, along);
    float t = select(clamp(dot(q, along) / max(l2, 1e-30f), 0.0f, 1.0f), 0.0f, l2 > 0.0f);
    vec2 d = q - along * t;
    return select(0.0f, 1.0f, dot(d, d) > radius * radius);
}

// A hexagon with sides at +-radius in x. The plane is folded until one side is left.
PATINA_FN float patternHexagon(vec2 at, float radius) {
    vec2 k = vec2(-0.866025f, 0.5f);
    vec2 p = vec2(abs(at.y), abs(at.x));
    p = p - k * (2.0f * min(dot(k, p), 0.0f));
    vec2 m = vec2(0.866025f, 0.5f);
    p = p - m * (2.0f * min(dot(m, p), 0.0f));
    float bound = 0.57735f * radius;
    p = p - vec2(clamp(p.x, -bound, bound), radius);
    return select(0.0f, 1.0f, p.x + p.y > 0.0f);
}

// Four circles around a middle.
PATINA_FN float patternCloverleaf(vec2 at, float radius) {
    vec2 p = at * 2.0f;
    float x = max(patternCircle(vec2(p.x + radius, p.y), radius),
                  patternCircle(vec2(p.x - radius, p.y), radius));
    float y = max(patternCircle(vec2(p.x, p.y - radius), radius),
                  patternCircle(vec2(p.x, p.y + radius), radius));
    return max(x, y);
}

PATINA_FN vec2 patternTile(vec2 uv, vec2 tiling, vec2 offset) {
    return uv * tiling - offset;
}

PATINA_FN float patternChecker(vec2 p) {
    return patternModulo(floor(p.x) + floor(p.y), 2.0f);
}

// A cell's own coordinates in [-1, 1]; with stagger every other row is moved by half a cell.
PATINA_FN vec2 patternCellOf(vec2 p, bool staggered) {
    float shift = select(0.5f, 0.0f, staggered && patternModulo(p.y, 2.0f) > 1.0f);
    return vec2(patternModulo(p.x + shift, 1.0f), patternModulo(p.y, 1.0f)) * 2.0f -
           vec2(1.0f, 1.0f);
}

PATINA_FN float patternGrid(vec2 p, float thickness, bool staggered) {
    vec2 c = patternCellOf(p, staggered);
    return select(1.0f, 0.0f, max(abs(c.x), abs(c.y)) > 1.0f - thickness);
}

PATINA_FN float patternCrosshatch(vec2 p, float thickness, bool staggered) {
    vec2 c = patternCellOf(p, staggered);
    return max(patternLine(c, vec2(1.0f, 1.0f), vec2(-1.0f, -1.0f), thickness),
               patternLine(c, vec2(-1.0f, 1.0f), vec2(1.0f, -1.0f), thickness));
}

// One of the round shapes: 0 circle, 1 cloverleaf, 2 hexagon.
PATINA_FN float patternShape(int shape, vec2 p, float radius) {
    if (shape == 0) return patternCircle(p, radius);
    if (shape == 1) return patternCloverleaf(p, radius);
    return patternHexagon(p, radius);
}

// The shapes side by side, or staggered with rows at a distance of row.
PATINA_FN float patternTiledShape(int shape, vec2 p, float size, bool staggered, float row) {
    if (!staggered)
        return patternShape(shape,
                            vec2(patternModulo(p.x, 1.0f), patternModulo(p.y, 1.0f)) * 2.0f -
                                vec2(1.0f, 1.0f),
                            size);
    float shift = select(0.5f, 0.0f, patternModulo(p.y, 2.0f * row) > row);
    float x = patternModulo(p.x + shift, 1.0f);
    float y = patternModulo(p.y, row);
    float inner = size * 0.5f;
    return max(
        max(patternShape(shape, vec2(x, y), inner), patternShape(shape, vec2(1.0f - x, y), inner)),
        patternShape(shape, vec2(x - 0.5f, row - y), inner));
}

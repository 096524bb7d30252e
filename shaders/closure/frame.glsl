// SPDX-License-Identifier: Apache-2.0
// Shading frames. World space; directions are unit vectors that point away from the surface.

struct Frame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
    vec3 wo; // the outgoing direction in this frame
};

PATINA_FN vec3 toLocal(Frame f, vec3 v) {
    return vec3(dot(v, f.tangent), dot(v, f.bitangent), dot(v, f.normal));
}
PATINA_FN vec3 toWorld(Frame f, vec3 v) {
    return f.tangent * v.x + f.bitangent * v.y + f.normal * v.z;
}

// Whether a vector of this length has a direction.
PATINA_FN bool hasDirection(float l) {
    return l > 1e-12f && l < 1e30f;
}
PATINA_FN vec3 unitOr(vec3 v, vec3 fallback) {
    float l = length(v);
    if (!hasDirection(l)) return fallback;
    return v / l;
}

// Two unit vectors that form a right-handed basis with n (Duff et al. 2017).
PATINA_FN void completeBasis(vec3 n, PATINA_OUT(vec3) x, PATINA_OUT(vec3) y) {
    float side = select(1.0f, -1.0f, n.z >= 0.0f);
    float a = -1.0f / (side + n.z);
    float b = n.x * n.y * a;
    x = vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x);
    y = vec3(b, side + n.y * n.y * a, -n.y);
}
PATINA_FN vec3 anyTangent(vec3 n) {
    vec3 x;
    vec3 y;
    completeBasis(n, x, y);
    return x;
}

// Sine of the smallest angle that the mirror direction keeps from the surface.
const float BEND_MARGIN = 1e-3f;

// Turns a normal as little as needed so that v sees its front and the mirror direction of v lies
// above the surface, both within a small margin. Interpolated and mapped normals at grazing angles
// would otherwise be black. g: geometric normal on the side of v.
PATINA_FN vec3 bendNormal(vec3 n, vec3 v, vec3 g) {
    float nv = dot(n, v);
    if (nv <= 0.0f) {
        vec3 turned = n + v * (BEND_MARGIN - nv);
        float l = length(turned);
        n = select(turned / l, g, hasDirection(l));
        nv = select(BEND_MARGIN / l, dot(g, v), hasDirection(l));
    }
    vec3 mirror = n * (2.0f * nv) - v;
    float above = dot(mirror, g);
    // Near grazing even the geometric normal's own mirror direction lies below the margin.
    float wanted = min(BEND_MARGIN, dot(v, g));
    if (above >= wanted) return n;
    // Half way from v to the mirror direction lifted by `lift`. At grazing angles the two are nearly
    // opposite, so that their sum holds few digits: it is put together from what is left of it.
    float lift = wanted - above;
    float l = length(mirror + g * lift);
    if (!hasDirection(l)) return g;
    float longer = lift * (2.0f * above + lift) / (l + 1.0f); // l - 1
    return unitOr(n * (2.0f * nv) + g * lift + v * longer, g);
}

// The least sine between a tangent and the normal. What is left of a tangent when its part along the normal is
// taken away is off by 2^-23 of its length, so that below this it is not square to the normal within 1e-3.
const float TANGENT_MIN = 1e-4f;
const float TANGENT_SLANTED = 0.5f;

// The direction v, in a frame, lifted above the horizon by the margin if it is not.
PATINA_FN vec3 liftedAbove(vec3 v) {
    if (v.z >= BEND_MARGIN) return v;
    float l = sqrt(v.x * v.x + v.y * v.y);
    vec2 along = select(vec2(v.x, v.y) / l, vec2(1.0f, 0.0f), hasDirection(l)) *
                 sqrt(1.0f - BEND_MARGIN * BEND_MARGIN);
    return vec3(along.x, along.y, BEND_MARGIN);
}

// Of a lobe. normal, tangent: as the material gives them, of any length; where they are unusable (0,
// not finite, parallel) those of the point stand in. flips: turn the frame to the viewer instead of
// keeping z on the outside. bends: the normal is bent. Lobes without a mirror direction keep their normal, which
// alone says how much light they get; wo is then lifted to where they can be seen from. They flip.
PATINA_FN Frame shadingFrame(vec3 view, vec3 geometricNormal, vec3 pointNormal, vec3 pointTangent,
                             vec3 normal, vec3 tangent, bool flips, bool bends) {
    float side = select(1.0f, -1.0f, dot(view, geometricNormal) >= 0.0f);
    Frame f;
    vec3 facing = unitOr(normal, pointNormal) * side;
    if (bends) facing = bendNormal(facing, view, geometricNormal * side);
    f.normal = select(facing, facing * side, flips);
    vec3 t = select(tangent, pointTangent, hasDirection(length(tangent)));
    float whole = length(t);
    t = t - f.normal * dot(f.normal, t);
    float l = length(t);
    f.tangent = t / l;
    // What is left of a slanted tangent holds few digits: once more, it is square to the normal.
    if (l < TANGENT_SLANTED * whole) f.tangent = unitOr(f.tangent - f.normal * dot(f.normal, f.tangent), f.tangent);
    if (!(l > TANGENT_MIN * whole && l < 1e30f)) f.tangent = anyTangent(f.normal);
    f.bitangent = cross(f.normal, f.tangent);
    f.wo = toLocal(f, view);
    if (!bends) f.wo = liftedAbove(f.wo);
    return f;
}

// SPDX-License-Identifier: Apache-2.0
// Samples of a sphere light that serve every point at once, as one shadow map per sample asks. Places are
// uniform on a sphere of four dimensions, projected (Archimedes): seen from far away they are spread evenly
// over the outline from every side, where half of the places on the surface would face away. They lie
// inside; light comes from where the way to them enters. The sphere is a unit sphere under an affine map.

// u: in the unit cube.
PATINA_FN vec3 sphereLightPlace(vec3 u) {
    float a = TWO_PI * u.y;
    float r = sqrt(max(1.0f - u.x, 0.0f));
    return vec3(r * cos(a), r * sin(a), sqrt(u.x) * cos(TWO_PI * u.z));
}

// The first point that a ray from outside meets. o, d: the ray in the sphere's coordinates, d as long as
// the map makes a unit vector; volume: determinant of the map to the world.
// t: distance; density: of the places above along the ray, by solid angle. Their density by volume, one
// over pi^2 sqrt(1 - r^2), is integrated over the ray's chord with t^2. Both are also set for rays that
// miss by rounding alone; density is 0 from inside, and of what is behind.
PATINA_FN bool sphereLightHit(vec3 o, vec3 d, float volume, PATINA_OUT(float) t, PATINA_OUT(float) density) {
    float a = dot(d, d);
    float middle = -dot(o, d) / max(a, 1e-30f);
    vec3 nearest = o + d * middle; // not the difference of squares, which small lights far away would be lost in
    float chord = 1.0f - dot(nearest, nearest);
    float h2 = max(chord, 0.0f) / max(a, 1e-30f);
    t = middle - sqrt(h2);
    density = 0.0f;
    if (dot(o, o) <= 1.0f || t <= 0.0f) return false;
    density = INV_PI * (middle * middle + 0.5f * h2) / (volume * sqrt(a));
    return chord > 0.0f;
}

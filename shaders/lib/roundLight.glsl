// Samples of round lights that serve every point at once, as one shadow map per sample asks: of the unit
// sphere, and of the cylinder |x| <= 1/2 of radius 1, under an affine map. Places are uniform on a sphere
// of one dimension more, projected (Archimedes): seen from far away they are spread evenly over the
// outline from every side, where half of the places on the surface would face away. They lie inside; light
// comes from where the way to them enters.

// u: in the unit cube.
PATINA_FN vec3 roundLightPlace(bool sphere, vec3 u) {
    float a = TWO_PI * u.y;
    if (!sphere) { // a section: the unit sphere, projected along z
        float z = 1.0f - 2.0f * u.z;
        float r = sqrt(max(1.0f - z * z, 0.0f));
        return vec3(u.x - 0.5f, r * cos(a), r * sin(a));
    }
    float r = sqrt(max(1.0f - u.x, 0.0f));
    return vec3(r * cos(a), r * sin(a), sqrt(u.x) * cos(TWO_PI * u.z));
}

// The first point of the emitting side that a ray meets. o, d: the ray in the shape's coordinates, d as
// long as the map makes a unit vector; volume: determinant of the map to the world.
// t: distance; density: of the places above along the ray, by solid angle. Their density by volume, over
// pi sqrt(1 - r^2) of the section, is integrated over the ray's chord with t^2.
PATINA_FN bool roundLightHit(bool sphere, vec3 o, vec3 d, float volume, PATINA_OUT(float) t,
                             PATINA_OUT(float) density) {
    vec3 across = vec3(sphere ? 1.0f : 0.0f, 1.0f, 1.0f);
    vec3 oc = o * across;
    vec3 dc = d * across;
    float a = dot(dc, dc);
    float b = dot(oc, dc);
    float c = dot(oc, oc) - 1.0f;
    float root = b * b - a * c;
    t = 0.0f;
    density = 0.0f;
    if (root <= 0.0f || a <= 0.0f || c <= 0.0f) return false;
    t = (-b - sqrt(root)) / a;
    if (t <= 0.0f) return false;
    float middle = -b / a;
    float h2 = root / (a * a);
    float even = middle * middle + 0.5f * h2;
    float scale = INV_PI / (volume * sqrt(a));
    if (sphere) {
        density = scale * even;
        return true;
    }
    if (abs(o.x + d.x * t) > 0.5f) return false;
    // Where the chord leaves by an end it is cut.
    float h = sqrt(h2);
    float low = -h;
    float high = h;
    if (abs(d.x) > 1e-20f) {
        float end = (select(0.5f, -0.5f, d.x > 0.0f) - o.x) / d.x - middle;
        high = min(end, h);
    }
    if (!(high > low)) return false;
    float edge = sqrt(max(h2 - high * high, 0.0f));
    float angle = PI - acos(max(min(high / h, 1.0f), -1.0f)); // from -pi/2 on
    density = 0.5f * scale * (even * angle - (2.0f * middle + 0.5f * high) * edge);
    return density > 0.0f;
}

// SPDX-License-Identifier: Apache-2.0
// Sphere lights, see ../shape.glsl. For one receiver samples are even over the cone that the sphere fills, in the shape's
// coordinates, where every affine image of a sphere is one.
const int SHAPE_SPHERE = 2;

PATINA_FN_RARE bool sphereHit(vec3 o, vec3 d, PATINA_OUT(float) t, PATINA_OUT(vec3) q) {
    t = 0.0f;
    q = o;
    float dd = dot(d, d);
    if (!(dd > 0.0f) || dot(o, o) <= 1.0f) return false; // from within there is nothing that emits
    float b = -dot(o, d) / dd;
    vec3 nearest = o + b * d; // safer than the textbook's discriminant
    float discriminant = 1.0f - dot(nearest, nearest);
    if (discriminant < 0.0f) return false;
    t = b - sqrt(discriminant / dd);
    q = o + t * d;
    return t > 0.0f;
}

PATINA_FN vec3 sphereNormal(PATINA_IN(ShapeFrame) s, vec3 q) {
    return normalize(shapeNormal(s, q));
}

// Passes of the rasterizer draw from within the cone of all receivers instead, see sphereInside.glsl.
PATINA_FN vec3 spherePlace(vec2 u) {
    float z = 1.0f - 2.0f * u.x;
    float r = sqrt(max(0.0f, 1.0f - z * z));
    return vec3(r * cos(TWO_PI * u.y), r * sin(TWO_PI * u.y), z);
}

PATINA_FN float spherePlaceDensity(PATINA_IN(ShapeFrame) s, vec3 q) {
    return 0.5f / (TWO_PI * s.volume * length(shapeNormal(s, q)));
}

PATINA_FN vec3 sphereExtent(PATINA_IN(ShapeFrame) s) {
    vec3 a = abs(s.axes[0]);
    vec3 b = abs(s.axes[1]);
    vec3 c = abs(s.axes[2]);
    return sqrt(a * a + b * b + c * c);
}

// 1 - cos of the half angle under which a unit sphere is seen from squared distance d2 > 1.
PATINA_FN float sphereVersine(float d2) {
    float sine2 = 1.0f / d2;
    return sine2 / (1.0f + sqrt(max(0.0f, 1.0f - sine2)));
}

PATINA_FN float spherePdf(PATINA_IN(ShapeFrame) s, vec3 point, vec3 position) {
    vec3 q = shapeLocal(s, point);
    float d2 = dot(q, q);
    if (!(d2 > 1.0f)) return 0.0f;
    float local = 1.0f / (2.0f * PI * sphereVersine(d2));
    // d(local solid angle) = d(solid angle) |det inverse| / |inverse direction|^3
    vec3 v = position - point;
    float localLength = length(s.inverse * v);
    float ratio = length(v) / localLength;
    return localLength > 0.0f ? local * ratio * ratio * ratio / s.volume : 0.0f;
}

// False where no part that emits faces the point.
PATINA_FN bool sphereSample(PATINA_IN(ShapeFrame) s, vec3 point, vec2 u, PATINA_OUT(ShapePoint) p) {
    vec3 q = shapeLocal(s, point);
    float d2 = dot(q, q);
    if (!(d2 > 1.0f)) return false;
    float h = u.x * sphereVersine(d2); // 1 - cos
    float sine2 = h * (2.0f - h);
    float cosine = 1.0f - h;
    float d = sqrt(d2);
    float phi = 2.0f * PI * u.y;
    LightBasis b = lightBasis(q / -d);
    vec3 w = cosine * b.z + sqrt(sine2) * (cos(phi) * b.x + sin(phi) * b.y);
    float t = d * cosine - sqrt(max(0.0f, 1.0f - d2 * sine2));
    vec3 on = normalize(q + t * w);
    p.position = s.origin + s.axes * on;
    p.normal = normalize(shapeNormal(s, on));
    p.pdf = spherePdf(s, point, p.position);
    return p.pdf > 0.0f;
}

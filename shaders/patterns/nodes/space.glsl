// SPDX-License-Identifier: Apache-2.0
// Points, vectors and normals from one space to another, and what belongs to the frame and the
// view.

// Modes of the transforms.
const int SPACE_KEPT = 0;
const int SPACE_TO_WORLD = 1;
const int SPACE_TO_OBJECT = 2;

// The linear part of the object's matrix; normals go by the inverse of its transpose.
PATINA_FN mat3 objectToWorld(PATINA_IN(SurfacePoint) p) {
    return transpose(inverse(p.objectToWorldNormal));
}

PATINA_FN vec3 nodeTransformPoint(vec3 v, NodeMode mode, PATINA_IN(SurfacePoint) p) {
    if (mode == SPACE_KEPT) return v;
    if (mode == SPACE_TO_WORLD)
        return objectToWorld(p) * (v - p.objectPosition) + worldPositionOf(p);
    return transpose(p.objectToWorldNormal) * (v - worldPositionOf(p)) + p.objectPosition;
}
PATINA_FN vec3 nodeTransformVector(vec3 v, NodeMode mode, PATINA_IN(SurfacePoint) p) {
    if (mode == SPACE_KEPT) return v;
    if (mode == SPACE_TO_WORLD) return objectToWorld(p) * v;
    return transpose(p.objectToWorldNormal) * v;
}
PATINA_FN vec3 nodeTransformNormal(vec3 n, NodeMode mode, PATINA_IN(SurfacePoint) p) {
    vec3 m = n;
    if (mode == SPACE_TO_WORLD) m = p.objectToWorldNormal * n;
    if (mode == SPACE_TO_OBJECT) m = inverse(p.objectToWorldNormal) * n;
    float l = length(m);
    return l > 0.0f && isFinite(l) ? m / l : n;
}

PATINA_FN vec3 nodeReflect(vec3 i, vec3 n) {
    return i - n * (2.0f * dot(n, i));
}
// eta: of the side that the vector comes from over that of the other. 0 at total reflection.
PATINA_FN vec3 nodeRefract(vec3 i, vec3 n, float eta) {
    float d = dot(i, n);
    float k = 1.0f - eta * eta * (1.0f - d * d);
    return k < 0.0f ? vec3(0.0f) : i * eta - n * (eta * d + sqrt(k));
}

// MaterialX's view direction points away from the eye, the network's towards it, so the sign is the
// other here.
PATINA_FN float nodeFacingRatio(vec3 view, vec3 n, bool faces, bool inverts) {
    float d = dot(view, n);
    float facing = faces ? abs(d) : d;
    return inverts ? 1.0f - facing : facing;
}

// Gooch et al. 1998, "A non-photorealistic lighting model for automatic technical illustration".
PATINA_FN vec4 nodeGooch(vec4 warm, vec4 cool, float intensity, float shininess, vec3 light,
                         PATINA_IN(SurfacePoint) p) {
    vec3 n = p.normal;
    vec3 v = -viewOf(p);
    float l2 = length(light);
    vec3 l = l2 > 0.0f ? light / l2 : vec3(0.0f, 0.0f, 1.0f);
    float share = 0.5f * (1.0f + dot(n, l));
    vec3 reflected = v - n * (2.0f * dot(n, v));
    float highlight = powSchlick(max(dot(-l, reflected), 0.0f), shininess) * intensity;
    return warm + (cool - warm) * share + highlight;
}

PATINA_FN float nodeFrame(float frame) {
    return frame;
}
PATINA_FN float nodeTime(float fps, float frame) {
    return fps != 0.0f ? frame / fps : 0.0f;
}

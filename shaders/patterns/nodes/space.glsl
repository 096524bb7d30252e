// SPDX-License-Identifier: Apache-2.0
// Points, vectors and normals from one space to another, and what belongs to the frame and the
// view.
#ifndef PATINA_NODE_ROWS

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

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

#define PATINA_SPACES "string fromspace=, string tospace="

const NodeRow rows[] = {
    {"ND_transformpoint_vector3", "transformpoint", "vector3 in=0, " PATINA_SPACES, "vector3",
     PATINA_PATTERN(nodeTransformPoint), Algebra::None, nullptr, prepareSpaces},
    {"ND_transformvector_vector3", "transformvector", "vector3 in=0, " PATINA_SPACES, "vector3",
     PATINA_PATTERN(nodeTransformVector), Algebra::None, nullptr, prepareSpaces},
    {"ND_transformnormal_vector3", "transformnormal", "vector3 in=0 0 1, " PATINA_SPACES, "vector3",
     PATINA_PATTERN(nodeTransformNormal), Algebra::None, nullptr, prepareSpaces},
    {"ND_reflect_vector3", "reflect", "vector3 in=1 0 0, vector3 normal=@Nworld", "vector3",
     PATINA_PATTERN(nodeReflect)},
    {"ND_refract_vector3", "refract", "vector3 in=1 0 0, vector3 normal=@Nworld, float ior=1",
     "vector3", PATINA_PATTERN(nodeRefract)},
    {"ND_facingratio_float", "facingratio",
     "vector3 viewdirection=@Vworld, vector3 normal=@Nworld, boolean faceforward=1, "
     "boolean invert=0",
     "float", PATINA_PATTERN(nodeFacingRatio)},
    {"ND_gooch_shade", "gooch_shade",
     "color3 warm_color=0.8 0.8 0.7, color3 cool_color=0.3 0.3 0.8, float specular_intensity=1, "
     "float shininess=64, vector3 light_direction=1 -0.5 -0.5",
     "color3", PATINA_PATTERN(nodeGooch)},
    // The host writes the number of the PATINA_PATTERN(nodeFrame) into the input `frame`, which
    // MaterialX does not have.
    {"ND_frame_float", "frame", "float frame=1", "float", PATINA_PATTERN(nodeFrame)},
    {"ND_time_float", "time", "float fps=24, float frame=1", "float", PATINA_PATTERN(nodeTime)},
};

#endif

// SPDX-License-Identifier: Apache-2.0
// Nodes that read the surface.

const int SPACE_WORLD = 0;
const int SPACE_OBJECT = 1;

PATINA_FN vec3 unitElse(vec3 v, vec3 fallback) {
    float l = length(v);
    return l > 0.0f ? v / l : fallback;
}
// Tangents go by the inverse of the object's matrix, which is the transpose of the normals'.
PATINA_FN vec3 tangentIn(vec3 t, int space, PATINA_IN(SurfacePoint) p) {
    if (space == SPACE_WORLD) return t;
    return unitElse(transpose(p.objectToWorldNormal) * t, vec3(1.0f, 0.0f, 0.0f));
}

PATINA_FN vec3 nodePosition(NodeMode space, PATINA_IN(SurfacePoint) p) {
    return space == SPACE_WORLD ? worldPositionOf(p) : p.objectPosition;
}
// Normals go to object space by the transpose of the object's matrix, which is the inverse of the
// one that brought them out.
PATINA_FN vec3 nodeNormal(NodeMode space, PATINA_IN(SurfacePoint) p) {
    if (space == SPACE_WORLD) return p.normal;
    return unitElse(inverse(p.objectToWorldNormal) * p.normal, vec3(0.0f, 0.0f, 1.0f));
}
PATINA_FN vec3 nodeTangent(NodeMode space, PATINA_IN(SurfacePoint) p) {
    return tangentIn(p.tangent, space, p);
}
PATINA_FN vec3 nodeBitangent(NodeMode space, PATINA_IN(SurfacePoint) p) {
    return tangentIn(p.bitangent, space, p);
}
PATINA_FN vec3 nodeViewDirection(NodeMode space, PATINA_IN(SurfacePoint) p) {
    return tangentIn(viewOf(p), space, p);
}
PATINA_FN bool nodeBackSide(PATINA_IN(SurfacePoint) p) {
    return dot(viewOf(p), p.geometricNormal) < 0.0f;
}

PATINA_FN vec3 nodeTexcoord(NodePrimvarOrZero set) {
    return vec3(set);
}
PATINA_FN float nodeGeomScalar(NodePrimvarOrZero color) {
    return color.x;
}
PATINA_FN vec4 nodeGeomColor(NodePrimvarOrBlack color) {
    return color;
}
PATINA_FN float nodeScalarPrimvar(NodePrimvar value) {
    return value.x;
}
PATINA_FN vec4 nodeTuplePrimvar(NodePrimvar value) {
    return value;
}

// Primvars of strings and matrices have no consumer among the nodes; their fallback is passed on.
PATINA_FN float nodeNoText() {
    return 0.0f;
}
PATINA_FN mat4 nodeFallbackMatrix(mat4 fallback) {
    return fallback;
}

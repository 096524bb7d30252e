// SPDX-License-Identifier: Apache-2.0
// Nodes that need their input at neighbouring points: places to look at it, and what follows.
#ifndef PATINA_NODE_ROWS

// Half a pixel, but no less than what floats can tell apart. In units of the uv set.
PATINA_FN float uvStep(PATINA_IN(SurfacePoint) p) {
    return max(0.5f * p.uvFootprint, 1.0f / 4096.0f);
}
PATINA_FN vec3 movedBy(vec3 v, vec3 d, bool world, PATINA_IN(SurfacePoint) p) {
    return v + (world ? d : transpose(p.objectToWorldNormal) * d);
}

PATINA_FN vec4 nodeShiftTexcoord(vec4 v, bool axis, PATINA_IN(SurfacePoint) p) {
    if (axis)
        v.y += uvStep(p);
    else
        v.x += uvStep(p);
    return v;
}
PATINA_FN vec3 nodeShiftPosition(vec3 v, bool axis, bool world, PATINA_IN(SurfacePoint) p) {
    vec3 d = (axis ? p.bitangent : p.tangent) * (uvStep(p) * p.lengthPerUv);
    return movedBy(v, d, world, p);
}

PATINA_FN vec3 slopeAlong(vec2 at, vec2 from, float rise, float k, float scale) {
    return vec3((at.x - from.x) * k, (at.y - from.y) * k, rise * k * scale);
}
// The normal of a height over the texture coordinates, of both here and a step along u and along v.
// The factor 1/16 is that of the Sobel filter which this node was once defined by.
PATINA_FN vec3 nodeSlope(float here, float alongU, float alongV, float scale, vec2 at, vec2 atU,
                         vec2 atV, PATINA_IN(SurfacePoint) p) {
    float k = 1.0f / uvStep(p);
    float s = scale / 16.0f;
    vec3 n =
        cross(slopeAlong(atU, at, alongU - here, k, s), slopeAlong(atV, at, alongV - here, k, s));
    if (n.z < 0.0f) n = -n; // mirrored coordinates
    float l = length(n);
    return (l > 1e-6f && l < 1e30f ? n / l : vec3(0.0f, 0.0f, 1.0f)) * 0.5f + 0.5f;
}
// Its value where the height is the same everywhere.
PATINA_FN vec3 nodeFlat() {
    return vec3(0.5f, 0.5f, 1.0f);
}

// Where a tap of a blur lies, in units of the uv set.
PATINA_FN_RARE vec2 blurTap(float size, int blur, int tap, bool gaussian,
                            PATINA_IN(SurfacePoint) p) {
    return max(size, 0.0f) * patternBlurTap(p.seed, blur, tap, gaussian);
}
PATINA_FN vec4 nodeMoveTexcoord(vec4 v, float size, int blur, int tap, bool gaussian,
                                PATINA_IN(SurfacePoint) p) {
    return v + vec4(blurTap(size, blur, tap, gaussian, p), 0.0f, 0.0f);
}
PATINA_FN vec3 nodeMovePosition(vec3 v, float size, int blur, int tap, bool gaussian, bool world,
                                PATINA_IN(SurfacePoint) p) {
    vec2 by = blurTap(size, blur, tap, gaussian, p);
    return movedBy(v, (p.tangent * by.x + p.bitangent * by.y) * p.lengthPerUv, world, p);
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

const NodeRow rows[] = {
    {"ND_heighttonormal_vector3", "heighttonormal",
     "float in=0, float scale=1, vector2 texcoord=@UV0", "vector3", PATINA_PATTERN(nodeFlat)},
    {"ND_blur_$", "blur", "$ in=0, float size=0, string filtertype=box", "$",
     PATINA_PATTERN(patternSame), Algebra::None, allTypes},
    {"PatinaShiftTexcoord_$", "shift_texcoord", "$ in=0, float axis=0", "$",
     PATINA_PATTERN(nodeShiftTexcoord), Algebra::None, "vector2 vector3"},
    {"PatinaShiftPosition", "shift_position", "vector3 in=0, float axis=0, float world=0",
     "vector3", PATINA_PATTERN(nodeShiftPosition)},
    {"PatinaMoveTexcoord_$", "move_texcoord",
     "$ in=0, float size=0, float blur=0, float tap=0, float gaussian=0", "$",
     PATINA_PATTERN(nodeMoveTexcoord), Algebra::None, "vector2 vector3"},
    {"PatinaMovePosition", "move_position",
     "vector3 in=0, float size=0, float blur=0, float tap=0, float gaussian=0, float world=0",
     "vector3", PATINA_PATTERN(nodeMovePosition)},
    {"PatinaSlope", "slope",
     "float here=0, float along_u=0, float along_v=0, float scale=1, "
     "vector2 texcoord=0, vector2 texcoord_u=0, vector2 texcoord_v=0",
     "vector3", PATINA_PATTERN(nodeSlope)},
};

#endif

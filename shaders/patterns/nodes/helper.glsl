// SPDX-License-Identifier: Apache-2.0
// Nodes that turn artistic parameters into those of lobes.
#ifndef PATINA_NODE_ROWS

PATINA_FN vec2 nodeGlossinessAnisotropy(float glossiness, float anisotropy) {
    return patternRoughnessAnisotropy(1.0f - glossiness, anisotropy);
}

PATINA_FN vec3 nodeArtisticIor(vec3 reflectivity, vec3 edge, PATINA_OUT(vec3) extinction) {
    vec3 ior =
        vec3(patternArtisticIor(reflectivity.x, edge.x), patternArtisticIor(reflectivity.y, edge.y),
             patternArtisticIor(reflectivity.z, edge.z));
    extinction = vec3(patternArtisticExtinction(reflectivity.x, ior.x),
                      patternArtisticExtinction(reflectivity.y, ior.y),
                      patternArtisticExtinction(reflectivity.z, ior.z));
    return ior;
}

PATINA_FN float nodeDispersedIor(float ior, float abbeNumber, float scale, NodeWavelength nm) {
    return patternDispersedIor(ior, abbeNumber, scale, nm);
}

// Reached at run time only by an input that varies.
PATINA_FN bool nodeIsUniform(PATINA_UNUSED(vec4, x)) {
    return false;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

const NodeRow rows[] = {
    {"ND_roughness_anisotropy", "roughness_anisotropy", "float roughness=0, float anisotropy=0",
     "vector2", PATINA_PATTERN(patternRoughnessAnisotropy)},
    {"ND_roughness_dual", "roughness_dual", "vector2 roughness=0", "vector2",
     PATINA_PATTERN(patternRoughnessDual)},
    {"ND_glossiness_anisotropy", "glossiness_anisotropy", "float glossiness=1, float anisotropy=0",
     "vector2", PATINA_PATTERN(nodeGlossinessAnisotropy)},
    {"ND_artistic_ior", "artistic_ior",
     "color3 reflectivity=0.944 0.776 0.373, color3 edge_color=0.998 0.981 0.751",
     "color3 ior, color3 extinction", PATINA_PATTERN(nodeArtisticIor)},
    {"ND_blackbody", "blackbody", "float temperature=5000", "color3",
     PATINA_PATTERN(patternBlackbody)},
    {"ND_patina_dispersed_ior", "patina_dispersed_ior",
     "float ior=1.5, float abbe_number=0, float scale=1", "float", PATINA_PATTERN(nodeDispersedIor),
     Algebra::Disperse},
    {"ND_isuniform_$", "isuniform", "$ in=0", "float", PATINA_PATTERN(nodeIsUniform),
     Algebra::IsUniform, "float color3"},
};

#endif

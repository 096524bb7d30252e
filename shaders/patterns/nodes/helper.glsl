// SPDX-License-Identifier: Apache-2.0
// Nodes that turn artistic parameters into those of lobes.

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

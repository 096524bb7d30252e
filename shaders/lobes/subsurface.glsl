// SPDX-License-Identifier: Apache-2.0
// Subsurface scattering: MaterialX subsurface_bsdf. Where nobody walks beneath the surface it shows
// as Lambert reflection.

struct SubsurfaceLobe {
    OrenNayarLobe diffuse;
    vec3 radius; // mean free path per channel, scene units
    float anisotropy;
};

// color: albedo of an infinitely thick object under diffuse light.
PATINA_FN SubsurfaceLobe subsurfaceSetup(vec3 color, vec3 radius, float anisotropy) {
    SubsurfaceLobe l;
    l.diffuse = orenNayarSetup(color, 0.0f, false);
    l.radius = max(radius, vec3(0.0f));
    l.anisotropy = anisotropy;
    return l;
}

PATINA_FN LobeEval subsurfaceEval(SubsurfaceLobe l, vec3 wo, vec3 wi) {
    return orenNayarEval(l.diffuse, wo, wi);
}

PATINA_FN LobeSample subsurfaceSample(SubsurfaceLobe l, vec3 wo, vec3 u) {
    return orenNayarSample(l.diffuse, wo, u);
}

PATINA_FN vec3 subsurfaceAlbedo(SubsurfaceLobe l, vec3 wo) {
    return orenNayarAlbedo(l.diffuse, wo);
}

PATINA_FN vec3 lobeFix(PATINA_INOUT(SubsurfaceLobe) l, PATINA_UNUSED(vec3, wo),
                       PATINA_OUT(vec3) albedo) {
    albedo = l.diffuse.color;
    return vec3(1.0f);
}

// SPDX-License-Identifier: Apache-2.0
// Interfaces of a thin slab, or between equal media, and presence: light that goes straight on.

struct Slab {
    vec3 transmittance; // share that goes straight on, without the lobe's weight
    vec3 reflected;     // factor on the reflection that is left as a lobe
};

// Both faces reflect, and light bounces between them. The sums of the series are the light that passes and the light
// that comes back. Roughness blurs only the reflection. once: reflectance of one face.
PATINA_FN Slab slabOf(vec3 once, vec3 tint, bool twoFaces, bool reflects) {
    vec3 bounces = select(once, vec3(0.0f), twoFaces);
    Slab s;
    s.transmittance = tint * (1.0f - once) / (1.0f + bounces);
    s.reflected = select(select(2.0f, 1.0f, twoFaces) / (1.0f + bounces), vec3(0.0f), reflects);
    return s;
}

// What does not pass is what that lobe sends back, not what a rough guess tells layers of it.
PATINA_FN int slabMethod(int albedo) {
    return select(ALBEDO_TABLE, albedo, albedo == ALBEDO_KARIS);
}

// Of a lobe beneath a reflecting one all passes, for that has taken its share. A lobe of mode RT
// keeps the light that it reflects: by a lobe of mode R, which a method of energy compensation may hold otherwise.
PATINA_FN Slab dielectricSlab(PATINA_INOUT(DielectricLobe) l, vec3 wo, PATINA_INOUT(vec3) albedo,
                              bool twoFaces) {
    bool reflects = l.mode == SCATTER_RT;
    if (reflects) l.mode = SCATTER_R;
    float once = 0.0f;
    l.albedo = slabMethod(l.albedo);
    if (!l.sharedInterface) once = dielectricEnergy(l, wo).r;
    if (reflects) {
        l.kr = select(1.0f, l.kr, dielectricAdds(l, wo.z));
        albedo = l.tint * once;
    }
    return slabOf(vec3(once), l.tint, twoFaces, reflects);
}
PATINA_FN Slab schlickSlab(PATINA_INOUT(SchlickLobe) l, vec3 wo, PATINA_INOUT(vec3) albedo,
                           bool twoFaces) {
    bool reflects = l.mode == SCATTER_RT;
    if (reflects) l.mode = SCATTER_R;
    vec3 once = vec3(0.0f);
    l.albedo = slabMethod(l.albedo);
    if (!l.sharedInterface) once = schlickEnergy(l, wo).r;
    if (reflects) {
        l.kr = select(vec3(1.0f), l.kr, schlickAdds(l, wo.z));
        albedo = once;
    }
    return slabOf(once, vec3(1.0f), twoFaces, reflects);
}

// The surface is only met with the chance that light does not pass straight: a factor on its lobes. Light passes as
// often as the mean of its channels does, so that no channel of a path that passes, or is met, weighs more than 3.
PATINA_FN float slabScale(vec3 passThrough) {
    float met = 1.0f - lobeMean(passThrough);
    return select(1.0f / met, 0.0f, met > 0.0f);
}

// Presence of a surface that passes light straight.
// passes: colour of light that goes on.
PATINA_FN float presenceOf(float opacity, vec3 passThrough, PATINA_OUT(vec3) passes) {
    float x = unit(opacity);
    float share = lobeMean(passThrough);
    float pass = 1.0f - x + x * share;
    passes = select((1.0f - x + x * passThrough) / pass, vec3(1.0f), pass > 0.0f);
    return x * (1.0f - share);
}

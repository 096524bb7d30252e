#include "materialNetwork/cpu/lobeSetup.h"

namespace patina {

namespace {

const char* const orenNayarNames[] = {"color", "roughness", nullptr};
const char* const subsurfaceNames[] = {"color", "radius", "anisotropy", nullptr};
const char* const burleyNames[] = {"color", "roughness", nullptr};
const char* const translucentNames[] = {"color", nullptr};
const char* const dielectricNames[] = {"tint",         "ior",  "roughness", "thinfilm_thickness",
                                       "thinfilm_ior", nullptr};
const char* const conductorNames[] = {
    "ior", "extinction", "roughness", "thinfilm_thickness", "thinfilm_ior", nullptr};
const char* const schlickNames[] = {"color0",       "color82",   "color90",
                                    "exponent",     "roughness", "thinfilm_thickness",
                                    "thinfilm_ior", nullptr};
const char* const sheenNames[] = {"color", "roughness", nullptr};
const char* const phongNames[] = {"color", "exponent", nullptr};
const char* const wardNames[] = {"color", "roughness", nullptr};
const char* const cookTorranceNames[] = {"color", "ior", "extinction", "roughness", nullptr};
const char* const hairNames[] = {"tint_R",        "tint_TT",       "tint_TRT",
                                 "ior",           "roughness_R",   "roughness_TT",
                                 "roughness_TRT", "cuticle_angle", "absorption_coefficient",
                                 nullptr};
const char* const noNames[] = {nullptr};

} // namespace

const char* const* lobeParameters(ClosureKind kind) {
    switch (kind) {
    case ClosureKind::OrenNayar: return orenNayarNames;
    case ClosureKind::Subsurface: return subsurfaceNames;
    case ClosureKind::Burley: return burleyNames;
    case ClosureKind::Translucent: return translucentNames;
    case ClosureKind::Dielectric: return dielectricNames;
    case ClosureKind::Conductor: return conductorNames;
    case ClosureKind::Schlick: return schlickNames;
    case ClosureKind::Sheen: return sheenNames;
    case ClosureKind::Phong:
    case ClosureKind::BlinnPhong: return phongNames;
    case ClosureKind::Ward: return wardNames;
    case ClosureKind::CookTorrance: return cookTorranceNames;
    case ClosureKind::ChiangHair: return hairNames;
    default: return noNames;
    }
}

LobeKind lobeKind(ClosureKind kind) {
    switch (kind) {
    case ClosureKind::Burley: return LobeKind::Burley;
    case ClosureKind::Subsurface: return LobeKind::Subsurface;
    case ClosureKind::Translucent: return LobeKind::Translucent;
    case ClosureKind::Dielectric: return LobeKind::Dielectric;
    case ClosureKind::Conductor: return LobeKind::Conductor;
    case ClosureKind::Schlick: return LobeKind::Schlick;
    case ClosureKind::Sheen: return LobeKind::Sheen;
    case ClosureKind::Phong: return LobeKind::Phong;
    case ClosureKind::BlinnPhong: return LobeKind::BlinnPhong;
    case ClosureKind::Ward: return LobeKind::Ward;
    case ClosureKind::CookTorrance: return LobeKind::CookTorrance;
    case ClosureKind::ChiangHair: return LobeKind::ChiangHair;
    default: return LobeKind::OrenNayar;
    }
}

void setupLobe(const LobeTemplate& t, const glm::vec4* r, BsdfLobe& out) {
    const auto color = [&](int i) { return glm::vec3(r[t.parameters[i]]); };
    const auto pair = [&](int i) { return glm::vec2(r[t.parameters[i]]); };
    const auto number = [&](int i) { return r[t.parameters[i]].x; };
    switch (t.prebuilt.kind) {
    case LobeKind::OrenNayar:
        out.orenNayar = sh::orenNayarModel(color(0), number(1), t.flagA, int(t.diffuse));
        return;
    case LobeKind::Subsurface:
        out.subsurface.diffuse = sh::orenNayarSetup(color(0), 0.0f, false);
        out.subsurface.radius = sh::max(color(1), glm::vec3(0.0f));
        out.subsurface.anisotropy = number(2);
        return;
    case LobeKind::Burley: out.burley = sh::burleySetup(color(0), number(1)); return;
    case LobeKind::Translucent: out.translucent = sh::translucentSetup(color(0)); return;
    case LobeKind::Dielectric:
        out.dielectric = sh::dielectricSetup(color(0), number(1), pair(2), t.flagA, t.mode,
                                             t.sharedInterface, t.compensate);
        out.dielectric.ndf = t.ndf;
        out.dielectric = sh::dielectricMethods(out.dielectric, t.albedo, t.sampling, t.fresnel);
        return;
    case LobeKind::Conductor:
        out.conductor = sh::conductorSetup(color(0), color(1), pair(2), t.flagA, t.compensate);
        out.conductor.ndf = t.ndf;
        if (t.film) out.conductor = sh::conductorFilm(out.conductor, number(3), number(4));
        out.conductor = sh::conductorMethods(out.conductor, t.albedo, t.sampling, t.filmMethod);
        out.conductor = sh::conductorFresnel(out.conductor, t.fresnel);
        return;
    case LobeKind::Schlick:
        if (t.filmDielectric) {
            out.schlick =
                sh::filmDielectricSetup(color(0), number(1), pair(2), number(3), number(4), t.flagA,
                                        t.mode, t.sharedInterface, t.compensate);
        } else {
            out.schlick = sh::schlickSetup(color(0), color(1), color(2), number(3), pair(4),
                                           t.flagA, t.mode, t.sharedInterface, t.compensate);
            if (t.film) out.schlick = sh::schlickFilm(out.schlick, number(5), number(6));
        }
        out.schlick.ndf = t.ndf;
        out.schlick = sh::schlickMethods(out.schlick, t.albedo, t.sampling, t.filmMethod);
        return;
    case LobeKind::Sheen:
        out.sheen = sh::sheenSetup(color(0), number(1), t.variant);
        out.sheen = sh::sheenMethods(out.sheen, t.sheenAlbedo);
        return;
    case LobeKind::Phong: out.phong = sh::phongSetup(color(0), number(1)); return;
    case LobeKind::BlinnPhong: out.blinnPhong = sh::blinnPhongSetup(color(0), number(1)); return;
    case LobeKind::Ward: out.ward = sh::wardSetup(color(0), pair(1), t.variant); return;
    case LobeKind::ChiangHair:
        out.chiangHair = sh::chiangHairSetup(color(0), color(1), color(2), number(3), pair(4),
                                             pair(5), pair(6), number(7), color(8));
        return;
    case LobeKind::CookTorrance:
        out.cookTorrance =
            sh::cookTorranceSetup(color(0), color(1), color(2), number(3), t.variant);
        return;
    case LobeKind::Layered: return;
    }
}

} // namespace patina

#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/cpu/energyCurve.h"

#include <algorithm>

// Dispatch from a BsdfLobe to the functions of its kind. Directions are in the lobe's frame.

namespace patina {

inline sh::LobeEval lobeEval(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& wi) {
    switch (l.kind) {
    case LobeKind::OrenNayar: return sh::orenNayarEval(l.orenNayar, wo, wi);
    case LobeKind::Burley: return sh::burleyEval(l.burley, wo, wi);
    case LobeKind::Translucent: return sh::translucentEval(l.translucent, wo, wi);
    case LobeKind::Dielectric: return sh::dielectricEval(l.dielectric, wo, wi);
    case LobeKind::Conductor: return sh::conductorEval(l.conductor, wo, wi);
    case LobeKind::Schlick: return sh::schlickEval(l.schlick, wo, wi);
    case LobeKind::Subsurface: return sh::orenNayarEval(l.subsurface.diffuse, wo, wi);
    case LobeKind::Sheen: return sh::sheenEval(l.sheen, wo, wi);
    case LobeKind::Phong: return sh::phongEval(l.phong, wo, wi);
    case LobeKind::BlinnPhong: return sh::blinnPhongEval(l.blinnPhong, wo, wi);
    case LobeKind::Ward: return sh::wardEval(l.ward, wo, wi);
    case LobeKind::CookTorrance: return sh::cookTorranceEval(l.cookTorrance, wo, wi);
    case LobeKind::ChiangHair: return sh::chiangHairEval(l.chiangHair, wo, wi);
    case LobeKind::Layered: break; // has no formula
    }
    return sh::lobeEvalNone();
}

inline sh::LobeSample lobeSample(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& u) {
    switch (l.kind) {
    case LobeKind::OrenNayar: return sh::orenNayarSample(l.orenNayar, wo, u);
    case LobeKind::Burley: return sh::burleySample(l.burley, wo, u);
    case LobeKind::Translucent: return sh::translucentSample(l.translucent, wo, u);
    case LobeKind::Dielectric: return sh::dielectricSample(l.dielectric, wo, u);
    case LobeKind::Conductor: return sh::conductorSample(l.conductor, wo, u);
    case LobeKind::Schlick: return sh::schlickSample(l.schlick, wo, u);
    case LobeKind::Subsurface: return sh::orenNayarSample(l.subsurface.diffuse, wo, u);
    case LobeKind::Sheen: return sh::sheenSample(l.sheen, wo, u);
    case LobeKind::Phong: return sh::phongSample(l.phong, wo, u);
    case LobeKind::BlinnPhong: return sh::blinnPhongSample(l.blinnPhong, wo, u);
    case LobeKind::Ward: return sh::wardSample(l.ward, wo, u);
    case LobeKind::CookTorrance: return sh::cookTorranceSample(l.cookTorrance, wo, u);
    case LobeKind::ChiangHair: return sh::chiangHairSample(l.chiangHair, wo, u);
    case LobeKind::Layered: break;
    }
    return sh::lobeSampleNone();
}

inline glm::vec3 lobeAlbedo(const BsdfLobe& l, const glm::vec3& wo) {
    switch (l.kind) {
    case LobeKind::OrenNayar: return sh::orenNayarAlbedo(l.orenNayar, wo);
    case LobeKind::Burley: return sh::burleyAlbedo(l.burley, wo);
    case LobeKind::Translucent: return sh::translucentAlbedo(l.translucent, wo);
    case LobeKind::Dielectric: return sh::dielectricAlbedo(l.dielectric, wo);
    case LobeKind::Conductor: return sh::conductorAlbedo(l.conductor, wo);
    case LobeKind::Schlick: return sh::schlickAlbedo(l.schlick, wo);
    case LobeKind::Subsurface: return sh::orenNayarAlbedo(l.subsurface.diffuse, wo);
    case LobeKind::Sheen: return sh::sheenAlbedo(l.sheen, wo);
    case LobeKind::Phong: return sh::phongAlbedo(l.phong, wo);
    case LobeKind::BlinnPhong: return sh::blinnPhongAlbedo(l.blinnPhong, wo);
    case LobeKind::Ward: return sh::wardAlbedo(l.ward, wo);
    case LobeKind::CookTorrance: return sh::cookTorranceAlbedo(l.cookTorrance, wo);
    case LobeKind::ChiangHair: return sh::chiangHairAlbedo(l.chiangHair, wo);
    case LobeKind::Layered: return l.albedo;
    }
    return glm::vec3(0.0f);
}

inline void setFactors(sh::DielectricLobe& l, const EnergyCurve::Energy& e) {
    l.kr = e.kr.x;
    l.kt = e.kt.x;
}

inline void setFactors(sh::SchlickLobe& l, const EnergyCurve::Energy& e) {
    l.kr = e.kr;
    l.kt = e.kt;
}

template <class Interface> glm::vec3 lobeSetEnergy(BsdfLobe& l, Interface& interface,
                                                   const glm::vec3& tint, const glm::vec3& wo,
                                                   const EnergyCurve& curve) {
    const EnergyCurve::Energy e = curve.covers(wo.z) ? curve.at(wo.z) : lobeEnergy(l, wo);
    interface.known = true;
    setFactors(interface, e);
    glm::vec3 coverage(0.0f);
    if ((interface.mode & sh::SCATTER_R) != 0) coverage += e.r;
    if ((interface.mode & sh::SCATTER_T) != 0) coverage += e.t;
    l.albedo = tint * coverage;
    return interface.mode == sh::SCATTER_T ? glm::vec3(1.0f) : coverage;
}

/// Looks up what depends on wo alone, once for all evaluations. Sets l.albedo, exact for interfaces
/// and else an estimate that is good enough to choose lobes by.
/// @returns the share that an interface or sheen keeps from the base of a layer, without tint. 1
/// for all other lobes.
inline glm::vec3 lobeFixWo(BsdfLobe& l, const glm::vec3& wo, const EnergyCurve& curve) {
    switch (l.kind) {
    case LobeKind::OrenNayar: l.albedo = l.orenNayar.color; return glm::vec3(1.0f);
    case LobeKind::Burley: l.albedo = l.burley.color; return glm::vec3(1.0f);
    case LobeKind::Subsurface: l.albedo = l.subsurface.diffuse.color; return glm::vec3(1.0f);
    case LobeKind::Translucent: l.albedo = l.translucent.color; return glm::vec3(1.0f);
    case LobeKind::Conductor:
        if (curve.covers(wo.z)) {
            l.conductor.known = true;
            l.conductor.k = curve.at(wo.z).kr;
        } else {
            l.conductor = sh::conductorAt(l.conductor, wo);
        }
        l.albedo = sh::conductorReflectance(l.conductor, glm::clamp(wo.z, 0.0f, 1.0f));
        return glm::vec3(1.0f);
    case LobeKind::Dielectric: return lobeSetEnergy(l, l.dielectric, l.dielectric.tint, wo, curve);
    case LobeKind::Schlick: return lobeSetEnergy(l, l.schlick, l.schlick.tint, wo, curve);
    case LobeKind::Sheen: {
        const float coverage = wo.z >= 0.0f ? sh::sheenWhiteAlbedo(l.sheen, wo.z) : 0.0f;
        l.albedo = l.sheen.color * coverage;
        return glm::vec3(coverage);
    }
    case LobeKind::Phong:
    case LobeKind::BlinnPhong:
    case LobeKind::Ward:
    case LobeKind::CookTorrance:
    case LobeKind::ChiangHair: l.albedo = lobeAlbedo(l, wo); return glm::vec3(1.0f);
    case LobeKind::Layered: return glm::vec3(1.0f);
    }
    return glm::vec3(1.0f);
}

inline bool lobeTransmits(const BsdfLobe& l) {
    switch (l.kind) {
    case LobeKind::Translucent:
    case LobeKind::ChiangHair: return true;
    case LobeKind::Dielectric: return (l.dielectric.mode & sh::SCATTER_T) != 0;
    case LobeKind::Schlick: return (l.schlick.mode & sh::SCATTER_T) != 0;
    case LobeKind::Layered: return l.layered.transmits;
    default: return false;
    }
}

/// Whether eval can be more than 0.
inline bool lobeNonDelta(const BsdfLobe& l) {
    switch (l.kind) {
    case LobeKind::Dielectric:
        return l.dielectric.alpha.x > 0.0f &&
               !(l.dielectric.mode == sh::SCATTER_T && l.dielectric.deltaT);
    case LobeKind::Conductor: return l.conductor.alpha.x > 0.0f;
    case LobeKind::Schlick:
        return l.schlick.alpha.x > 0.0f && !(l.schlick.mode == sh::SCATTER_T && l.schlick.deltaT);
    default: return true;
    }
}

/// GGX alpha, mean of both axes; 1 for diffuse lobes.
inline float lobeRoughness(const BsdfLobe& l) {
    switch (l.kind) {
    case LobeKind::Dielectric: return 0.5f * (l.dielectric.alpha.x + l.dielectric.alpha.y);
    case LobeKind::Conductor: return 0.5f * (l.conductor.alpha.x + l.conductor.alpha.y);
    case LobeKind::Schlick: return 0.5f * (l.schlick.alpha.x + l.schlick.alpha.y);
    case LobeKind::Phong: return sh::phongAlpha(l.phong.exponent);
    case LobeKind::BlinnPhong: return sh::phongAlpha(l.blinnPhong.exponent);
    case LobeKind::Ward: return 0.5f * (l.ward.alpha.x + l.ward.alpha.y);
    case LobeKind::CookTorrance: return l.cookTorrance.alpha;
    default: return 1.0f;
    }
}

} // namespace patina

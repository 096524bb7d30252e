#pragma once

#include "materialNetwork/cpu/bsdf.h"

// Dispatch from a BsdfLobe to the functions of its kind. Directions are in the lobe's frame.

namespace patina {

inline sh::LobeEval lobeEval(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& wi) {
    switch (l.kind) {
    case LobeKind::OrenNayar:
        return sh::orenNayarEval(l.orenNayar, wo, wi);
    case LobeKind::Burley:
        return sh::burleyEval(l.burley, wo, wi);
    case LobeKind::Translucent:
        return sh::translucentEval(l.translucent, wo, wi);
    case LobeKind::Dielectric:
        return sh::dielectricEval(l.dielectric, wo, wi);
    case LobeKind::Conductor:
        return sh::conductorEval(l.conductor, wo, wi);
    case LobeKind::Schlick:
        return sh::schlickEval(l.schlick, wo, wi);
    }
    return sh::lobeEvalNone();
}

inline sh::LobeSample lobeSample(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& u) {
    switch (l.kind) {
    case LobeKind::OrenNayar:
        return sh::orenNayarSample(l.orenNayar, wo, u);
    case LobeKind::Burley:
        return sh::burleySample(l.burley, wo, u);
    case LobeKind::Translucent:
        return sh::translucentSample(l.translucent, wo, u);
    case LobeKind::Dielectric:
        return sh::dielectricSample(l.dielectric, wo, u);
    case LobeKind::Conductor:
        return sh::conductorSample(l.conductor, wo, u);
    case LobeKind::Schlick:
        return sh::schlickSample(l.schlick, wo, u);
    }
    return sh::lobeSampleNone();
}

inline glm::vec3 lobeAlbedo(const BsdfLobe& l, const glm::vec3& wo) {
    switch (l.kind) {
    case LobeKind::OrenNayar:
        return sh::orenNayarAlbedo(l.orenNayar, wo);
    case LobeKind::Burley:
        return sh::burleyAlbedo(l.burley, wo);
    case LobeKind::Translucent:
        return sh::translucentAlbedo(l.translucent, wo);
    case LobeKind::Dielectric:
        return sh::dielectricAlbedo(l.dielectric, wo);
    case LobeKind::Conductor:
        return sh::conductorAlbedo(l.conductor, wo);
    case LobeKind::Schlick:
        return sh::schlickAlbedo(l.schlick, wo);
    }
    return glm::vec3(0.0f);
}

/// Looks up what depends on wo alone, once for all evaluations.
inline void lobeFixWo(BsdfLobe& l, const glm::vec3& wo) {
    if (l.kind == LobeKind::Dielectric)
        l.dielectric = sh::dielectricAt(l.dielectric, wo);
    else if (l.kind == LobeKind::Conductor)
        l.conductor = sh::conductorAt(l.conductor, wo);
    else if (l.kind == LobeKind::Schlick)
        l.schlick = sh::schlickAt(l.schlick, wo);
}

inline bool lobeTransmits(const BsdfLobe& l) {
    switch (l.kind) {
    case LobeKind::Translucent:
        return true;
    case LobeKind::Dielectric:
        return (l.dielectric.mode & sh::SCATTER_T) != 0;
    case LobeKind::Schlick:
        return (l.schlick.mode & sh::SCATTER_T) != 0;
    default:
        return false;
    }
}

/// Whether eval can be more than 0.
inline bool lobeNonDelta(const BsdfLobe& l) {
    switch (l.kind) {
    case LobeKind::Dielectric:
        return l.dielectric.alpha.x > 0.0f &&
               !(l.dielectric.mode == sh::SCATTER_T && l.dielectric.deltaT);
    case LobeKind::Conductor:
        return l.conductor.alpha.x > 0.0f;
    case LobeKind::Schlick:
        return l.schlick.alpha.x > 0.0f && !(l.schlick.mode == sh::SCATTER_T && l.schlick.deltaT);
    default:
        return true;
    }
}

/// GGX alpha, mean of both axes; 1 for diffuse lobes.
inline float lobeRoughness(const BsdfLobe& l) {
    switch (l.kind) {
    case LobeKind::Dielectric:
        return 0.5f * (l.dielectric.alpha.x + l.dielectric.alpha.y);
    case LobeKind::Conductor:
        return 0.5f * (l.conductor.alpha.x + l.conductor.alpha.y);
    case LobeKind::Schlick:
        return 0.5f * (l.schlick.alpha.x + l.schlick.alpha.y);
    default:
        return 1.0f;
    }
}

/// What an interface reflects away from the base of a layer: the largest channel, without tint.
inline float lobeReflected(const BsdfLobe& l, const glm::vec3& wo) {
    if (l.kind == LobeKind::Dielectric) {
        if (l.dielectric.mode == sh::SCATTER_T)
            return 1.0f;
        sh::DielectricLobe untinted = l.dielectric;
        untinted.tint = glm::vec3(1.0f);
        return sh::dielectricAlbedo(untinted, wo).x;
    }
    if (l.schlick.mode == sh::SCATTER_T)
        return 1.0f;
    const glm::vec3 a = sh::schlickAlbedo(l.schlick, wo);
    return a.x > a.y ? (a.x > a.z ? a.x : a.z) : (a.y > a.z ? a.y : a.z);
}

} // namespace patina

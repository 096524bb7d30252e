// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/ir/energyCurve.h"
#include "materialNetwork/ir/lobeFacts.h"

// Dispatch from a BsdfLobe to the functions of its kind. Directions are in the lobe's frame.

namespace patina {

inline sh::LobeEval lobeEval(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& wi) {
    switch (l.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        return sh::prefix##Eval(l.prefix, wo, wi);
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: break; // has no formula
    }
    return sh::lobeEvalNone();
}

inline sh::LobeSample lobeSample(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& u) {
    switch (l.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        return sh::prefix##Sample(l.prefix, wo, u);
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: break;
    }
    return sh::lobeSampleNone();
}

inline glm::vec3 lobeAlbedo(const BsdfLobe& l, const glm::vec3& wo) {
    switch (l.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        return sh::prefix##Albedo(l.prefix, wo);
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: return l.albedo;
    }
    return glm::vec3(0.0f);
}

/// Calls f with the lobe itself and its traits as a type; not for layers that are walked.
template <lobe::Trait traits> using LobeTraits = std::integral_constant<lobe::Trait, traits>;
template <class F> auto withLobe(const BsdfLobe& l, F f) {
    switch (l.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        return f(l.prefix, LobeTraits<(traits)>());
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: break;
    }
    return decltype(f(l.orenNayar, LobeTraits<lobe::None>()))();
}

template <class L> glm::vec3 fixLobe(L& l, glm::vec3 (*albedoOf)(L, glm::vec3), const glm::vec3& wo,
                                     glm::vec3& albedo) {
    if constexpr (LobeHasFix<L>::value) return sh::lobeFix(l, wo, albedo);
    albedo = albedoOf(l, wo);
    return glm::vec3(1.0f);
}

/// lobeFixWo() where a curve knows the energy.
inline glm::vec3 lobeFixBy(BsdfLobe& l, const EnergyCurve::Energy& e, const glm::vec3& wo) {
    if (l.kind == LobeKind::Dielectric)
        return sh::dielectricWith(l.dielectric, {e.kr.x, e.kt.x, e.r.x, e.t.x}, l.albedo);
    if (l.kind == LobeKind::Schlick)
        return sh::schlickWith(l.schlick, {e.kr, e.kt, e.r, e.t}, l.albedo);
    l.conductor.known = true;
    l.conductor.k = e.kr;
    l.albedo = sh::conductorReflectance(l.conductor, glm::clamp(wo.z, 0.0f, 1.0f));
    return glm::vec3(1.0f);
}

/// Looks up what depends on wo alone, once for all evaluations. Sets l.albedo, exact for interfaces
/// and else an estimate that is good enough to choose lobes by.
/// @returns the share that an interface or sheen keeps from the base of a layer, without tint. 1
/// for all other lobes.
inline glm::vec3 lobeFixWo(BsdfLobe& l, const glm::vec3& wo, const EnergyCurve& curve) {
    if (curve.covers(wo.z)) return lobeFixBy(l, curve.at(wo.z), wo);
    switch (l.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        return fixLobe(l.prefix, sh::prefix##Albedo, wo, l.albedo);
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: break;
    }
    return glm::vec3(1.0f);
}

inline bool lobeTransmits(const BsdfLobe& l) {
    if (l.kind == LobeKind::Layered) return l.layered.transmits;
    return withLobe(l, []([[maybe_unused]] const auto& x, auto traits) {
        if constexpr ((traits() & lobe::Interface) != 0) return (x.mode & sh::SCATTER_T) != 0;
        return (traits() & lobe::Transmits) != 0;
    });
}

/// The share of its light that a lobe sends down for good. @param z of wo
inline float lobePasses(const BsdfLobe& l, [[maybe_unused]] float z) {
    return withLobe(l, [z]([[maybe_unused]] const auto& x, auto traits) {
        if constexpr ((traits() & lobe::Interface) != 0) {
            if (x.mode != sh::SCATTER_RT) return float(x.mode == sh::SCATTER_T);
            return sh::lobePasses(x, z);
        }
        return (traits() & lobe::Transmits) != 0 ? 1.0f : 0.0f;
    });
}

/// Whether eval can be more than 0.
inline bool lobeNonDelta(const BsdfLobe& l) {
    if (l.kind == LobeKind::Layered) return true;
    return withLobe(l, []([[maybe_unused]] const auto& x, auto) {
        if constexpr (LobeHasDelta<std::decay_t<decltype(x)>>::value) return !sh::lobeIsDelta(x);
        return true;
    });
}

/// GGX alpha, mean of both axes; 1 for diffuse lobes.
inline float lobeRoughness(const BsdfLobe& l) {
    if (l.kind == LobeKind::Layered) return 1.0f;
    return withLobe(l, []([[maybe_unused]] const auto& x, auto) {
        if constexpr (LobeHasRoughness<std::decay_t<decltype(x)>>::value)
            return sh::lobeRoughness(x);
        return 1.0f;
    });
}

} // namespace patina

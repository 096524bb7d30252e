// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/measure/places.h"
#include "shaders/shaders.h"

#include <string>

namespace patina::measure {

/// A lobe of one of the kinds at one place, for what is measured of lights.
struct Reflector {
    enum Kind { Diffuse, Sheen, Dielectric, Conductor };

    Kind kind;
    sh::ConductorLobe metal;
    sh::DielectricLobe plastic;
    sh::OrenNayarLobe diffuse;
    sh::SheenLobe sheen;
    sh::vec3 wo;
    float alpha;

    /// @param p alpha is the roughness of sheen too, its root that of diffuse lobes
    Reflector(Kind k, const Place& p) : kind(k), wo(p.wo), alpha(float(p.alpha)) {
        metal = sh::conductorAt(sh::conductorSetup(sh::vec3(float(measuredMetals[0].n)),
                                                   sh::vec3(float(measuredMetals[0].k)),
                                                   sh::vec2(alpha), false, sh::COMPENSATE_SCALE),
                                wo);
        plastic = sh::dielectricAt(sh::dielectricSetup(sh::vec3(1.0f), 1.5f, sh::vec2(alpha), false,
                                                       sh::SCATTER_R, false, sh::COMPENSATE_SCALE),
                                   wo);
        diffuse = sh::orenNayarSetup(sh::vec3(0.5f), std::sqrt(alpha), true);
        sheen = sh::sheenSetup(sh::vec3(1.0f), alpha, sh::SHEEN_CONTY_KULLA);
    }

    /// As the table of methods names it.
    static const char* name(Kind kind) {
        const char* names[] = {"diffuse", "sheen", "dielectric", "conductor"};
        return names[kind];
    }
    /// Whether its facets are mirrors, so that it shows the light around one direction.
    bool mirrors() const { return kind == Dielectric || kind == Conductor; }

    sh::LobeEval eval(const sh::vec3& wi) const {
        switch (kind) {
        case Diffuse: return sh::orenNayarEval(diffuse, wo, wi);
        case Sheen: return sh::sheenEval(sheen, wo, wi);
        case Dielectric: return sh::dielectricEval(plastic, wo, wi);
        default: return sh::conductorEval(metal, wo, wi);
        }
    }
    sh::LobeSample sample(const sh::vec3& u) const {
        switch (kind) {
        case Diffuse: return sh::orenNayarSample(diffuse, wo, u);
        case Sheen: return sh::sheenSample(sheen, wo, u);
        case Dielectric: return sh::dielectricSample(plastic, wo, u);
        default: return sh::conductorSample(metal, wo, u);
        }
    }
    float albedo() const {
        switch (kind) {
        case Diffuse: return sh::orenNayarAlbedo(diffuse, wo).x;
        case Sheen: return sh::sheenAlbedo(sheen, wo).x;
        case Dielectric: return sh::dielectricAlbedo(plastic, wo).x;
        default: return sh::conductorAlbedo(metal, wo).x;
        }
    }
};

} // namespace patina::measure

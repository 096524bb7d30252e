// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/aovTable.h"

#include <string>
#include <vector>

namespace patina {

/// The requested AOVs that only the fragment stage of a material can tell.
struct RasterAovRequest {
    static constexpr size_t maxPrimvars = 4; ///< targets that drivers have beside the others

    bool albedo = false;
    bool geometricNormal = false;      ///< takes the target of a primvar
    std::vector<std::string> primvars; ///< names, at most room()
    std::vector<std::string> leftOut;  ///< further ones

    RasterAovRequest() = default;
    /// @param aovs by name; further primvars are told in `leftOut`
    explicit RasterAovRequest(const std::vector<std::string>& aovs) {
        std::vector<std::string> asked;
        for (const std::string& aov : aovs) {
            const AovId id = aovIdOf(aov);
            albedo |= id == AovId::albedo || id == AovId::denoisingAlbedo;
            geometricNormal |= id == AovId::Ng;
            if (id == AovId::primvars) asked.push_back(aov.substr(sizeof primvarAovs - 1));
            if (id != AovId::unknown && aovRows()[size_t(id)].primvar)
                asked.emplace_back(aovRows()[size_t(id)].primvar);
        }
        for (const std::string& name : asked) {
            if (slot(primvars, name) >= 0 || slot(leftOut, name) >= 0) continue;
            (primvars.size() < room() ? primvars : leftOut).push_back(name);
        }
    }

    size_t room() const { return maxPrimvars - (geometricNormal ? 1 : 0); }

    /// For aovs.frag.glsl.
    std::string text() const {
        return std::string(albedo ? "#define AOV_ALBEDO\n" : "") +
               (geometricNormal ? "#define AOV_NG\n" : "") + "#define AOV_PRIMVARS " +
               std::to_string(primvars.size()) + "\n#define AOV_PREF " +
               std::to_string(slot(primvars, aovRows()[size_t(AovId::Pref)].primvar)) + "\n";
    }

    /// Values that a surface carries: the primvars of its material, and those asked for.
    std::vector<std::string> with(std::vector<std::string> ofMaterial) const {
        for (const std::string& name : primvars)
            if (slot(ofMaterial, name) < 0) ofMaterial.push_back(name);
        return ofMaterial;
    }

    /// @returns -1 where it is not there
    static int slot(const std::vector<std::string>& primvars, const std::string& name) {
        for (size_t i = 0; i < primvars.size(); ++i)
            if (primvars[i] == name) return int(i);
        return -1;
    }

    bool operator==(const RasterAovRequest& o) const {
        return albedo == o.albedo && geometricNormal == o.geometricNormal &&
               primvars == o.primvars && leftOut == o.leftOut;
    }
};

} // namespace patina

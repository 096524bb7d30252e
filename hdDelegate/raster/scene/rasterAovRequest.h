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
    std::vector<std::string> primvars; ///< names, at most `maxPrimvars`
    std::vector<std::string> leftOut;  ///< further ones

    RasterAovRequest() = default;
    /// @param aovs by name, `primvars:NAME` for those; further primvars are told in `leftOut`
    explicit RasterAovRequest(const std::vector<std::string>& aovs) {
        for (const std::string& aov : aovs) {
            const AovId id = aovIdOf(aov);
            albedo |= id == AovId::albedo || id == AovId::denoisingAlbedo;
            if (id != AovId::primvars) continue;
            auto& list = primvars.size() < maxPrimvars ? primvars : leftOut;
            list.push_back(aov.substr(sizeof primvarAovs - 1));
        }
    }

    /// For aovs.frag.glsl.
    std::string text() const {
        return (albedo ? "#define AOV_ALBEDO\n" : "") +
               ("#define AOV_PRIMVARS " + std::to_string(primvars.size()) + "\n");
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
        return albedo == o.albedo && primvars == o.primvars && leftOut == o.leftOut;
    }
};

} // namespace patina

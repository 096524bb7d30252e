// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/aovs.h"

#include "hdDelegate/film/film.h"

#include <pxr/base/gf/vec2f.h>
#include <pxr/base/gf/vec3f.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/base/tf/diagnostic.h>

#include <stdexcept>

namespace patina {

std::string filmAovOf(const TfToken& hydraName) {
    for (const AovRow& row : aovRows())
        if (row.hydraName && hydraName == row.hydraName) return row.name;
    const std::string name = aovNamed(hydraName.GetString());
    const AovId id = aovIdOf(name);
    if (id == AovId::unknown || isOfQuarters(id)) return "";
    if (id != AovId::lpe) return name;
    if (lightPathAovOf(name).expression == "C.*") return "color";
    try {
        return standardAov(name).name;
    } catch (const std::invalid_argument& error) {
        TF_WARN("%s", error.what());
        return "";
    }
}

HdPatinaShownAov shownAovOf(const TfToken& hydraName) {
    HdPatinaShownAov shown;
    shown.layer = cryptomatteLayerOf(hydraName, shown.film);
    if (shown.layer >= 0) return shown;
    shown.film = filmAovOf(hydraName);
    if (shown.film.empty() || standardAov(shown.film).kind != AovKind::Coverage) return shown;
    TF_WARN("AOV %s has several layers; its buffer stays empty. Buffers %s00, %s01... show them",
            hydraName.GetText(), hydraName.GetText(), hydraName.GetText());
    return {};
}

HdAovDescriptor aovDescriptor(const TfToken& hydraName) {
    std::string matte;
    if (cryptomatteLayerOf(hydraName, matte) >= 0)
        return {HdFormatFloat32Vec4, false, VtValue(GfVec4f(0.0f))};
    const std::string name = filmAovOf(hydraName);
    if (name.empty()) return HdAovDescriptor();
    const AovSpec spec = standardAov(name);
    if (spec.kind == AovKind::Coverage) return HdAovDescriptor(); // its layers are
    if (spec.id == AovId::color) return {HdFormatFloat16Vec4, false, VtValue(GfVec4f(0.0f))};
    if (spec.isInteger) return {HdFormatInt32, false, VtValue(-1)};
    switch (spec.components) {
    case 1: return {HdFormatFloat32, false, VtValue(spec.id == AovId::deviceDepth ? 1.0f : 0.0f)};
    case 2: return {HdFormatFloat32Vec2, false, VtValue(GfVec2f(0.0f))};
    default: return {HdFormatFloat32Vec3, false, VtValue(GfVec3f(0.0f))};
    }
}

} // namespace patina

#include "hdDelegate/hydra/aovs.h"

#include "hdDelegate/film/film.h"

#include <pxr/base/gf/vec2f.h>
#include <pxr/base/gf/vec3f.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/imaging/hd/tokens.h>

#include <stdexcept>

namespace patina {

std::string filmAovOf(const TfToken& hydraName) {
    std::string name = hydraName.GetString();
    if (hydraName == HdAovTokens->depth)
        name = "deviceDepth";
    else if (hydraName == HdAovTokens->cameraDepth)
        name = "depth";
    try {
        return standardAov(name).name;
    } catch (const std::invalid_argument&) {
        return std::string();
    }
}

HdAovDescriptor aovDescriptor(const TfToken& hydraName) {
    const std::string name = filmAovOf(hydraName);
    if (name.empty()) return HdAovDescriptor();
    const AovSpec spec = standardAov(name);
    if (name == "color") return {HdFormatFloat16Vec4, false, VtValue(GfVec4f(0.0f))};
    if (spec.isInteger) return {HdFormatInt32, false, VtValue(-1)};
    switch (spec.components) {
    case 1: return {HdFormatFloat32, false, VtValue(name == "deviceDepth" ? 1.0f : 0.0f)};
    case 2: return {HdFormatFloat32Vec2, false, VtValue(GfVec2f(0.0f))};
    default: return {HdFormatFloat32Vec3, false, VtValue(GfVec3f(0.0f))};
    }
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/lightFilter.h"
#include "hdDelegate/scene/lightPortal.h"
#include "hdDelegate/scene/types.h"
#include "materialNetwork/network/network.h"

namespace patina {

enum class LightType {
#define PATINA_LIGHT(Type, word, schemas, hydra) Type,
#include "hdDelegate/scene/lightTypes.inc"
};

/// A row of lightTypes.inc.
struct LightRow {
    LightType type;
    const char *word, *schemas, *hydra;
    bool flat; ///< shines to one side of a plane
};

inline constexpr LightRow lightRows[] = {
#define PATINA_LIGHT(Type, word, schemas, hydra) {LightType::Type, word, schemas, hydra, false},
#define PATINA_AREA_LIGHT(Type, word, schemas, hydra, number, flat, ...)                           \
    {LightType::Type, word, schemas, hydra, flat},
#include "hdDelegate/scene/lightTypes.inc"
};

constexpr const LightRow& lightRow(LightType type) {
    return lightRows[int(type)];
}

/// A UsdLux light with its inputs as authored (units: the UsdLux overview). Fallbacks are those of
/// the schema.
struct Light {
    std::string path;
    std::string group; ///< prototype it belongs to; empty means the world
    LightType type = LightType::Sphere;
    MotionTransform transform{mat4(1.0f)};
    bool visible = true;       ///< off: it emits nothing
    bool cameraVisible = true; ///< dome or area light seen directly by the camera

    // inputs of the schemas; explained in lightTypes.inc
#define PATINA_LIGHT_INPUT(group, type, field, key, input, fallback, description)                  \
    type field = fallback;
#include "hdDelegate/scene/lightTypes.inc"

    std::string textureColorSpace; ///< empty or "auto": by file type

    /// Nodes that inputs are connected to, each a terminal of the input's name. A scene has for
    /// them a material whose displacement is the colour that varies over a dome or a rect, or
    /// nothing.
    Network network;
    /// Its radiance is not the same everywhere: the texture, or what the network paints.
    bool hasImage() const {
        return !textureFile.empty() || !network.empty();
    }

    /// The ShapingAPI is applied: an unauthored one shapes nothing.
    bool shapingConeAuthored = false;

    // linking: empty lights (or shadows) everything; else a name found in Geometry::categories
    std::string lightLink;
    std::string shadowLink;

    std::vector<LightFilter> filters; ///< in their order; they multiply
    std::vector<LightPortal> portals; ///< dome

    std::string lightGroup; ///< its label in light path expressions; empty: none

    // MeshLightAPI: path of the mesh that emits
    std::string geometry;
    std::string materialSyncMode = "materialGlowTintsLight";
};

} // namespace patina

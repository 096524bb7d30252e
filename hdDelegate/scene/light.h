#pragma once

#include "hdDelegate/scene/types.h"

namespace patina {

enum class LightType { Distant, Dome, Sphere, Disk, Rect, Cylinder, Mesh };

/// A UsdLux light with its inputs as authored (units: the UsdLux overview). Fallbacks are those of
/// the schema.
struct Light {
    std::string path;
    std::string group; ///< prototype it belongs to; empty means the world
    LightType type = LightType::Sphere;
    MotionTransform transform{mat4(1.0f)};
    bool visible = true;       ///< off: it emits nothing
    bool cameraVisible = true; ///< dome or area light seen directly by the camera

    // LightAPI
    vec3 color{1.0f};
    float intensity = 1.0f;
    float exposure = 0.0f;
    float diffuse = 1.0f;
    float specular = 1.0f;
    bool normalize = false;
    bool enableColorTemperature = false;
    float colorTemperature = 6500.0f; ///< kelvin

    // shapes
    float angle = 0.53f;               ///< distant, degrees across
    float radius = 0.5f;               ///< sphere, disk, cylinder
    float width = 1.0f, height = 1.0f; ///< rect
    float length = 1.0f;               ///< cylinder, along local x
    bool treatAsPoint = false;         ///< sphere
    bool treatAsLine = false;          ///< cylinder

    // textures
    std::string textureFile; ///< dome, rect; resolved path
    std::string textureFormat =
        "automatic";               ///< dome: latlong, mirroredBall, angular, cubeMapVerticalCross
    std::string textureColorSpace; ///< empty or "auto": by file type
    float guideRadius = 0.0f;

    // ShapingAPI
    float shapingFocus = 0.0f;
    vec3 shapingFocusTint{0.0f};
    float shapingConeAngle = 180.0f;
    float shapingConeSoftness = 0.0f;
    bool shapingConeAuthored =
        false; ///< the ShapingAPI is applied: an unauthored one shapes nothing
    std::string iesFile;
    float iesAngleScale = 0.0f;
    bool iesNormalize = false;

    // ShadowAPI
    bool shadowEnable = true;
    vec3 shadowColor{0.0f};
    float shadowDistance = -1.0f;
    float shadowFalloff = -1.0f;
    float shadowFalloffGamma = 1.0f;

    // linking: empty lights (or shadows) everything; else a name found in Geometry::categories
    std::string lightLink;
    std::string shadowLink;

    // MeshLightAPI: path of the mesh that emits
    std::string geometry;
    std::string materialSyncMode = "materialGlowTintsLight";
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/areaShape.h"
#include "hdDelegate/lights/lightShaping.h"

namespace patina {

class Diagnostics;
struct SceneState;
struct RenderSettings;

bool isFinite(const vec3& v);
bool isFinite(const mat4& m);

/// The kind of light that a UsdLux prim becomes, and its brightness: the same for every renderer.
/// Spheres and cylinders that ask for it (treatAsPoint, treatAsLine), or that normalize and have no
/// radius, become points and lines.
struct ResolvedLight {
    enum class Kind { None, Area, Point, Line, Distant, Dome };

    Kind kind = Kind::None;
    /// A direction or a place of no extent, which no ray can hit.
    bool delta = false;
    /// Of points the intensity, of lines the intensity across per length, of distant lights of
    /// angle 0 the irradiance on a plane that faces them. Negative of lights that take light away.
    vec3 radiance{0.0f};
    /// Of distant lights: half the angle, and 1 - cos of it without cancellation.
    float halfAngle = 0.0f, versine = 0.0f;

    /// Luminance without the sign, by which lights are chosen: what takes light away counts by how
    /// much.
    float power() const;
};

/// @returns kind None for a light that gives no light; reasons that look like mistakes are warned
/// of
ResolvedLight resolveLight(const Light& light, const mat4& toWorld, Diagnostics& diagnostics);

/// Whether some light that is on has a channel below zero, so that pixels may be negative.
bool takesLightAway(const SceneState& state, const RenderSettings& settings);

/// Where a light is at one time, by what it is treated as.
struct LightPose {
    AreaShape shape;        ///< of areas
    LightShaping shaping;   ///< of all but lights at infinity
    vec3 position{0.0f};    ///< of points, middle of lines
    vec3 along{0.0f};       ///< of lines, all of its length
    vec3 toLight{0.0f};     ///< of distant lights
    mat3 domeToWorld{1.0f}; ///< a rotation, maybe with a reflection
};

/// @param profile may be null
LightPose lightPose(const Light& light, ResolvedLight::Kind kind, const mat4& toWorld,
                    std::shared_ptr<const IesProfile> profile);

/// The IES profile of a light at a place. @returns null without one; a warning tells of bad files
std::shared_ptr<const IesProfile> lightProfile(const Light& light, Diagnostics& diagnostics);

/// A profile as a table of shaders/lights/table.glsl, scaled as the light wants it. It has one row
/// where all turns about the axis are alike.
struct ProfileGrid {
    int thetas = 0, phis = 0;
    std::vector<float> values;
};
ProfileGrid profileGrid(const Light& light, const IesProfile& profile, int thetas, int phis);

} // namespace patina

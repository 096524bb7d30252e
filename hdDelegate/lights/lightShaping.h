// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/iesProfile.h"
#include "hdDelegate/scene/light.h"
#include "base/maths.h"
#include "shaders/lights.h"

#include <memory>

namespace patina {

/// How a light's emission varies with direction (UsdLux ShapingAPI): cone and focus by
/// shaders/lights/shaping.glsl, and candela(scaled angle) of an IES profile, divided by the
/// profile's mean when it normalizes.
class LightShaping {
public:
    LightShaping() = default;
    /// @param profile may be null
    LightShaping(const Light& light, const mat4& toWorld,
                 std::shared_ptr<const IesProfile> profile);

    bool active() const { return _active; }
    /// @param direction unit, world space, away from the light
    vec3 factor(const vec3& direction) const;
    /// Cone and focus, and the light's axes; as GLSL has it, too.
    const shLights::Shaping& beam() const { return _beam; }
    const vec3& axis() const { return _beam.axis; } ///< unit
    /// No light leaves at more than this angle off the axis, radians.
    float cutoff() const { return _beam.coneEnd; }
    /// Rough mean of the factor inside the cutoff, for choosing among lights.
    float level() const { return _level; }

private:
    bool _active = false;
    shLights::Shaping _beam = {vec3(0.0f, 0.0f, -1.0f),
                               vec3(1.0f, 0.0f, 0.0f),
                               vec3(0.0f, 1.0f, 0.0f),
                               vec3(0.0f),
                               0.0f,
                               false,
                               pi,
                               pi};
    std::shared_ptr<const IesProfile> _profile;
    float _profileScale = 1.0f, _angleScale = 0.0f, _level = 1.0f;
};

} // namespace patina

#pragma once

#include "hdDelegate/image/iesProfile.h"
#include "hdDelegate/scene/light.h"

#include <memory>

namespace patina {

/// How a light's emission varies with direction (UsdLux ShapingAPI). The formulas are those of the
/// schema's documentation, all angles measured from the light's axis, its local -z:
///   focus     lerp(|cos|^focus, focusTint, 1)
///   cone      1 - smoothstep(lerp(softness, cutoff, 0), cutoff, angle), softness clamped to 0..1
///   IES       candela(scaled angle), divided by the profile's mean when it normalizes
class LightShaping {
public:
    LightShaping() = default;
    /// @param profile may be null
    LightShaping(const Light& light, const mat4& toWorld,
                 std::shared_ptr<const IesProfile> profile);

    bool active() const { return _active; }
    /// @param direction unit, world space, away from the light
    vec3 factor(const vec3& direction) const;
    const vec3& axis() const { return _axis; } ///< unit
    const vec3& x() const { return _x; }       ///< local x across the axis, unit
    const vec3& y() const { return _y; }
    /// No light leaves at more than this angle off the axis, radians.
    float cutoff() const { return _cutoff; }
    /// Rough mean of the factor inside the cutoff, for choosing among lights.
    float level() const { return _level; }

private:
    bool _active = false;
    vec3 _axis{0.0f, 0.0f, -1.0f};
    vec3 _x{1.0f, 0.0f, 0.0f}, _y{0.0f, 1.0f, 0.0f};
    float _focus = 0.0f;
    vec3 _focusTint{0.0f};
    float _cutoff = 3.14159265f, _smoothStart = 3.14159265f;
    bool _cone = false;
    std::shared_ptr<const IesProfile> _profile;
    float _profileScale = 1.0f, _angleScale = 0.0f, _level = 1.0f;
};

} // namespace patina

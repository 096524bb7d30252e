// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/apertureShape.h"
#include "hdDelegate/compiled/cameraFrame.h"
#include "hdDelegate/compiled/distortionMap.h"

namespace patina {

/// A ray in camera space.
struct LensRay {
    vec3 origin{0.0f};
    vec3 direction{0, 0, -1}; ///< any length
    bool seen = true;         ///< false: the film has no picture there
};

/// Rays of cameras that have more than UsdGeomCamera: other projections, two eyes, lenses of
/// blades, and distortion. How is chosen once, when it is made.
class LensRays {
public:
    /// @param distortion null: none
    LensRays(const Camera& camera, const CameraFrame& frame,
             std::shared_ptr<const DistortionMap> distortion);

    /// Whether a camera needs it.
    static bool needed(const CameraLens& lens) { return lens != CameraLens(); }

    /// @param pixel as of CameraRays::ray()
    /// @param within a place of the part of the image that the same eye has
    /// @param lens two numbers for the lens, in [0,1)
    LensRay ray(vec2 pixel, vec2 lens, vec2 within) const;

private:
    /// A place of the film in space: a direction, the eye's way to the right and up in its plane.
    struct View {
        vec3 origin{0.0f}, direction{0, 0, -1}, right{1, 0, 0}, up{0, 1, 0};
        bool seen = true;
    };
    using Project = View (LensRays::*)(const vec2& place) const;

    vec2 window(const vec2& place) const;
    View perspective(const vec2& place) const;
    View orthographic(const vec2& place) const;
    View cylindrical(const vec2& place) const;
    View spherical(const vec2& place) const;
    View fisheye(const vec2& place) const;
    float angleOf(float radius) const; ///< from a fisheye's axis; radius 0..1

    static Project projectOf(const CameraLens& lens, bool orthographic);
    float sideOf(const vec2& within, vec2& corner) const;

    CameraLens _lens;
    CameraFrame _frame;
    std::shared_ptr<const DistortionMap> _distortion;
    ApertureShape _aperture;
    Project _project;
    vec2 _fields;
    float _towards; ///< one over the distance where both eyes see the same place
};

} // namespace patina

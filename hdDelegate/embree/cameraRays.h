// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/screenMotion.h"
#include "hdDelegate/embree/lensRays.h"

#include <memory>
#include <optional>

namespace patina {

/// A ray of the camera, with the widening of its cone.
struct CameraRay {
    vec3 origin{0.0f};
    vec3 direction{0, 0, -1};
    float near = 0.0f, far = 0.0f; ///< distances along direction
    float time = 0.0f;             ///< 0 shutter open, 1 shutter close
    float coneWidth = 0.0f;        ///< at the origin, scene units
    float coneSpread = 0.0f;       ///< growth per unit of distance
    bool seen = true;              ///< false: there is no ray, the film has no picture there
};

/// Makes rays for a camera and an image.
class CameraRays {
public:
    /// @param origin of the space that rays are wanted in, see seenFrom()
    /// @param distortion of the lens; null: none
    CameraRays(const Camera& camera, const RenderSettings& settings,
               const dvec3& origin = dvec3(0.0),
               std::shared_ptr<const DistortionMap> distortion = nullptr);

    /// @param pixel image position in pixels, (0,0) is the top left corner of the top left pixel
    /// @param lens two numbers for the lens, in [0,1)
    /// @param time in [0,1)
    CameraRay ray(vec2 pixel, vec2 lens, float time) const { return ray(pixel, lens, time, pixel); }
    /// @param within where both eyes share the image: a place in the part of the wanted one
    CameraRay ray(vec2 pixel, vec2 lens, float time, vec2 within) const;

    /// At the middle of the shutter, from the space with that origin.
    const mat4& worldToCamera() const { return _worldToCamera; }
    /// Depth in [0,1] as OpenGL's default window depth, of a camera space point.
    float windowDepth(const vec3& cameraPoint) const { return _frame.windowDepth(cameraPoint); }
    float depthOf(const vec3& cameraPoint) const { return _frame.depthOf(cameraPoint); }
    float depthAt(const vec3& place) const { ///< of a place in the space of the rays
        return depthOf(vec3(_worldToCamera * vec4(place, 1.0f)));
    }
    float pixelSpread() const { return _pixelSpread; } ///< see CameraFrame
    bool orthographic() const { return _frame.orthographic; }
    const Camera& camera() const { return _camera; }
    const CameraFrame& frame() const { return _frame; }
    const ScreenMotion& motion() const { return _motion; } ///< of places in the world

private:
    mat4 transformAt(float time) const;

    Camera _camera;
    CameraFrame _frame;
    std::optional<LensRays> _lens; ///< of cameras that need it
    dvec3 _origin;
    bool _moves;
    float _pixelSpread;
    mat4 _worldToCamera{1.0f};
    ScreenMotion _motion;
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/plan/primExtent.h"
#include "hdDelegate/scene/camera.h"
#include "hdDelegate/scene/settings.h"

namespace patina {

/// The frame that a camera and the settings describe: its window, lens and shutter. The conform
/// policy of the settings decides which aperture yields when the image has another shape. Where
/// both eyes share the image, each has a window of its own.
struct CameraFrame {
    CameraFrame(const Camera& camera, const RenderSettings& settings);

    vec2 imageSize{1.0f};                           ///< pixels of the film, with overscan
    vec2 eyeSize{1.0f};                             ///< pixels of the part of one eye
    vec2 windowMin{0.0f}, windowMax{0.0f};          ///< at distance 1; orthographic: scene units
    float lensRadius = 0.0f;                        ///< scene units; 0: everything is sharp
    float focusDistance = 0.0f;                     ///< scene units
    float shutterOpen = 0.0f, shutterLength = 0.0f; ///< time codes relative to the frame
    float clipNear = 0.0f, clipFar = 0.0f;
    bool orthographic = false;
    bool radial = false; ///< distances count from the centre, not along the axis

    /// The smallest angle (radians; scene units when orthographic) that one pixel covers.
    float pixelSpread() const { return _pixelSpread; }
    /// Distance that `depth` and the clipping range measure, in scene units from the camera.
    float depthOf(const vec3& cameraPoint) const {
        return radial ? glm::length(cameraPoint) : -cameraPoint.z;
    }
    float timeCode(float time) const { return shutterOpen + time * shutterLength; } ///< of 0..1
    /// Depth in [0,1] as OpenGL's default window depth over the camera's own clipping range.
    float windowDepth(const vec3& cameraPoint) const;

private:
    float _pixelSpread = 0.0f;
};

/// When the shutter opens and closes, time codes relative to the frame. Without motion blur, or
/// where it never opens, all is as at the frame's time.
vec2 shutterOf(const Camera& camera, const RenderSettings& settings);

/// Where the camera is in the middle of the shutter.
dvec3 cameraPlace(const Camera& camera, const RenderSettings& settings);
/// How large things look from there. @param origin of the space that they are in, see seenFrom()
ScreenScale screenScale(const Camera& camera, const RenderSettings& settings, const dvec3& origin);

/// The best origin of a space that holds the things in view in numbers of 32 bits, which are too
/// coarse for things that are small and far away. It is 0, the world's own origin, if that is
/// within `far` sizes. Otherwise it is a corner of a grid, so that small moves of the camera change
/// nothing.
/// @param middle, size of the things in view, scene units
/// @param far sizes
/// @param cell of the grid, sizes at least
dvec3 originNear(const dvec3& middle, double size, double far, double cell);

} // namespace patina

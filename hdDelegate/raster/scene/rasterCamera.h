// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/apertureShape.h"
#include "hdDelegate/compiled/cameraFrame.h"
#include "base/diagnostics.h"

#include <algorithm>
#include <vector>

namespace patina {

/// The view of one pass: matrices for one point of the pixel, the lens and the shutter.
struct RasterView {
    mat4 worldToClip{1.0f}, clipToWorld{1.0f};
    vec3 eye{0.0f}, forward{0, 0, -1}; ///< world
    bool perspective = true;
    float pixelSpread = 0.0f; ///< angle of a pixel; its width when orthographic
    float fitted = 0.0f;      ///< from the camera's near plane to that of worldToClip
    float reach = 0.0f;       ///< from the camera's near plane to its far plane
    std::vector<vec4> planes; ///< world; what is behind one is not seen
};

/// A camera as it is rasterized: without what only rays draw, which is told by camera and
/// attribute.
Camera rasterizedCamera(Camera camera, Diagnostics& diagnostics);

/// The camera of a rasterized image.
class RasterCamera {
public:
    RasterCamera(const Camera& camera, const RenderSettings& settings);

    /// @param offset of the sample from the pixel's centre, in pixels, y down
    /// @param lens two numbers for the lens, in [0,1)
    /// @param time in [0,1) over the shutter
    /// @param boundsMin,boundsMax of the scene; the depth range is fitted to them
    /// @param border pixels that are drawn beside the image on every side
    RasterView view(vec2 offset, vec2 lens, float time, const vec3& boundsMin,
                    const vec3& boundsMax, int border = 0) const;

    float timeCode(float time) const { return _frame.timeCode(time); }
    const mat4& worldToCamera() const { return _worldToCamera; } ///< at the middle of the shutter
    float windowDepth(const vec3& cameraPoint) const { return _frame.windowDepth(cameraPoint); }
    /// Radius of what the lens blurs a point over, in the scene.
    float blurAt(float distance) const;
    const Camera& camera() const { return _camera; }
    const CameraFrame& frame() const { return _frame; }
    float pixels() const { ///< along the longer side
        return std::max(_frame.imageSize.x, _frame.imageSize.y);
    }

private:
    Camera _camera;
    CameraFrame _frame;
    ApertureShape _aperture;
    float _eye = 0.0f; ///< of two: from their middle to the right
    mat4 _worldToCamera{1.0f};
};

} // namespace patina

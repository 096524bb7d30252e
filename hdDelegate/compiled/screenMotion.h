// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/cameraFrame.h"
#include "hdDelegate/compiled/instanceValues.h"

namespace patina {

/// How far places move in the image from frame to frame, for the AOVs motionForward and
/// motionBackward. A frame is a time code.
class ScreenMotion {
public:
    enum Moment { Before, Now, After };
    static float timeCode(Moment moment) { return float(moment) - 1.0f; } ///< from the frame

    ScreenMotion(const Camera& camera, const CameraFrame& frame);

    /// Whether that is known of a camera: a plane without distortion, and one eye.
    static bool knows(const Camera& camera) { return camera.lens.hasOverscan(); }

    /// @param now, then the place in the world at the frame's time and at that moment
    /// @param out pixels, x right, y down
    /// @returns false where the camera does not see one of them from in front
    bool way(const dvec3& now, const dvec3& then, Moment moment, float out[2]) const;

    /// From a prim's own space to the world.
    /// @param steps of the instances around it, from the outermost
    static dmat4 toWorld(const Geometry& prim, const InstanceStep* steps, int count, Moment moment);

private:
    bool pixelOf(const dvec3& place, Moment moment, glm::dvec2& pixel) const;

    CameraFrame _frame;
    dmat4 _worldToCamera[3];
    double _eye = 0.0; ///< of two: from their middle to the right
    double _towards = 0.0;
    bool _known;
};

} // namespace patina

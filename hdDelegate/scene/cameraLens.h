// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

namespace patina {

struct Camera;

/// How a camera's film becomes directions.
enum class LensProjection {
    Standard,             ///< perspective or orthographic, as UsdGeomCamera says
    FisheyeEquidistant,   ///< distance from the film's middle is proportional to the angle
    FisheyeEquisolid,     ///< ... to the sine of half the angle: equal areas are equal solid angles
    FisheyeStereographic, ///< ... to the tangent of half the angle: shapes keep their angles
    Cylindrical,          ///< longitude across, a perspective up
    Spherical             ///< longitude across, latitude up
};

/// Which eyes an image shows.
enum class StereoView { Mono, Left, Right, SideBySide, OverUnder }; ///< the left eye left, or above

/// The parts of a camera beyond UsdGeomCamera. cameraInputs.def has the attributes and their
/// ranges.
struct CameraLens {
    LensProjection projection = LensProjection::Standard;
    float fieldOfView = 0.0f;            ///< degrees across; 0: the projection's own
    float verticalFieldOfView = 0.0f;    ///< degrees; 0: the projection's own; fisheyes have none
    int apertureBlades = 0;              ///< fewer than 3: a disk
    float apertureBladeCurvature = 0.0f; ///< 0 straight, 1 a disk, below 0 bent inwards
    float apertureRotation = 0.0f;       ///< degrees, counterclockwise as the camera looks
    float apertureAspect = 1.0f;         ///< height over width
    StereoView stereo = StereoView::Mono;
    float interocularDistance = 0.0f;               ///< scene units
    float convergenceDistance = 0.0f;               ///< scene units; 0: the eyes look in parallel
    std::string distortionMap;                      ///< resolved path of an image; empty: none
    float distortionK1 = 0.0f, distortionK2 = 0.0f; ///< of squared half diagonals of the film

    bool operator==(const CameraLens& other) const;
    bool operator!=(const CameraLens& other) const { return !(*this == other); }
    bool standard() const { return projection == LensProjection::Standard; }
    /// Whether the film can reach beyond the frame: its middle has no meaning of its own.
    bool hasOverscan() const {
        return standard() && stereo != StereoView::SideBySide && stereo != StereoView::OverUnder &&
               distortionMap.empty() && distortionK1 == 0.0f && distortionK2 == 0.0f;
    }
    bool fisheye() const {
        return projection == LensProjection::FisheyeEquidistant ||
               projection == LensProjection::FisheyeEquisolid ||
               projection == LensProjection::FisheyeStereographic;
    }
    /// Radians across and up, with the projection's own where none is given: a fisheye has 180
    /// degrees both ways, a cylinder 360 and 90, a sphere 360 and 180.
    vec2 fieldsOfView() const;
};

/// Width over height that an image of a camera has of itself: that of the aperture, or of the
/// fields of view; twice or half as much where both eyes share it. 16 / 9 where there is none.
double imageAspect(const Camera& camera);

/// Whether a camera has what only rays show: a projection that is no plane, distortion, both eyes.
bool needsRays(const Camera& camera);

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/cameraLens.h"

namespace patina {

/// The opening of a lens: a disk, or a polygon of blades, whose corners are at distance 1. Its
/// boundary is at R(phi) = (1 - c) cos(pi / n) / cos(phi) + c, phi from the middle of a side, c the
/// curvature: the polygon at 0, the disk at 1, a star below 0.
class ApertureShape {
public:
    explicit ApertureShape(const CameraLens& lens);

    bool isDisk() const { return _blades == 0; } ///< of radius 1, but for its aspect
    vec2 scale() const { return _scale; }        ///< of the width and the height

    /// Where the boundary is, without its aspect.
    /// @param angle from the middle of a side, radians, within half a side
    float boundary(float angle) const;

    /// A place, uniform by area. Continuous in u, but across the first corner.
    /// @param u in [0,1)
    vec2 sample(const vec2& u) const;

private:
    float angleOf(float share) const;
    float areaTo(float angle) const;

    int _blades = 0;
    float _half = 0.0f; ///< half of the angle of a side
    float _curvature = 0.0f, _inner = 1.0f, _halfArea = 0.0f, _rotation = 0.0f;
    vec2 _scale{1.0f};
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

namespace patina {

/// Uniform sampling of the solid angle that a rectangle fills (Urena, Fajardo and King 2013, An
/// Area-Preserving Parametrization for Spherical Rectangles). In double precision, as the angles
/// cancel.
class SphericalRect {
public:
    /// @param corner,edgeX,edgeY the rectangle; the edges stand at right angles
    /// @returns false when the rectangle is too small or too flat from here to be sampled so
    bool setup(const vec3& corner, const vec3& edgeX, const vec3& edgeY, const vec3& point);
    vec3 sample(const vec2& u) const; ///< a position on the rectangle
    float pdf() const { return float(1.0 / _solidAngle); }
    double solidAngle() const { return _solidAngle; }

private:
    glm::dvec3 _point, _x, _y, _z;
    double _x0, _x1, _y0, _y1, _z0;
    double _b0, _b1, _k, _solidAngle = 0.0;
};

} // namespace patina

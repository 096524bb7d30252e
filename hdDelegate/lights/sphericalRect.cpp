// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/sphericalRect.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

using glm::dvec3;

bool SphericalRect::setup(const vec3& corner, const vec3& edgeX, const vec3& edgeY,
                          const vec3& point) {
    _point = dvec3(point);
    const double lengthX = glm::length(dvec3(edgeX)), lengthY = glm::length(dvec3(edgeY));
    _x = dvec3(edgeX) / lengthX;
    _y = dvec3(edgeY) / lengthY;
    _z = glm::cross(_x, _y);
    const dvec3 d = dvec3(corner) - _point;
    _x0 = glm::dot(d, _x);
    _y0 = glm::dot(d, _y);
    _z0 = glm::dot(d, _z);
    if (_z0 > 0.0) {
        _z = -_z;
        _z0 = -_z0;
    }
    if (!(_z0 < 0.0)) return false;
    _x1 = _x0 + lengthX;
    _y1 = _y0 + lengthY;
    // Normals of the four planes through the point and an edge have only two parts that matter.
    const double zz = _z0 * _z0;
    const double n0 = -_y0 / std::sqrt(zz + _y0 * _y0); // edge y0: z part
    const double n1 = _x1 / std::sqrt(zz + _x1 * _x1);
    const double n2 = _y1 / std::sqrt(zz + _y1 * _y1);
    const double n3 = -_x0 / std::sqrt(zz + _x0 * _x0);
    const auto angle = [](double a, double b) { return std::acos(std::clamp(-a * b, -1.0, 1.0)); };
    const double g0 = angle(n0, n1), g1 = angle(n1, n2), g2 = angle(n2, n3), g3 = angle(n3, n0);
    _b0 = n0;
    _b1 = n2;
    _k = 2.0 * piDouble - g2 - g3;
    _solidAngle = g0 + g1 - _k;
    return _solidAngle > 1e-7;
}

vec3 SphericalRect::sample(const vec2& u) const {
    const double angle = double(u.x) * _solidAngle + _k;
    const double f = (std::cos(angle) * _b0 - _b1) / std::sin(angle);
    const double c = std::clamp(std::copysign(1.0, f) / std::sqrt(f * f + _b0 * _b0), -1.0, 1.0);
    const double x = std::clamp(-(c * _z0) / std::sqrt(std::max(1.0 - c * c, 1e-30)), _x0, _x1);
    const double d2 = x * x + _z0 * _z0;
    const double h0 = _y0 / std::sqrt(d2 + _y0 * _y0), h1 = _y1 / std::sqrt(d2 + _y1 * _y1);
    const double h = h0 + double(u.y) * (h1 - h0), h2 = h * h;
    const double y = h2 < 1.0 - 1e-12 ? std::clamp(h * std::sqrt(d2 / (1.0 - h2)), _y0, _y1) : _y1;
    return vec3(_point + x * _x + y * _y + _z0 * _z);
}

} // namespace patina

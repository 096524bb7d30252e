// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/apertureShape.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

ApertureShape::ApertureShape(const CameraLens& lens)
    : _curvature(lens.apertureBladeCurvature), _rotation(glm::radians(lens.apertureRotation)),
      _scale(1.0f / lens.apertureAspect, 1.0f) {
    if (lens.apertureBlades < 3 || _curvature == 1.0f) return;
    _blades = lens.apertureBlades;
    _half = pi / float(_blades);
    _inner = std::cos(_half);
    _halfArea = areaTo(_half);
}

float ApertureShape::boundary(float angle) const {
    return (1.0f - _curvature) * _inner / std::cos(angle) + _curvature;
}

/// Twice the area from the middle of a side to an angle: the integral of the squared boundary.
float ApertureShape::areaTo(float angle) const {
    const float straight = (1.0f - _curvature) * _inner, round = _curvature;
    return straight * straight * std::tan(angle) +
           2.0f * straight * round * std::asinh(std::tan(angle)) + round * round * angle;
}

/// The angle up to which a half side has a share of its area: Newton's method, within brackets.
float ApertureShape::angleOf(float share) const {
    if (_curvature == 0.0f) return std::atan(share * std::tan(_half));
    const float wanted = share * _halfArea;
    float low = 0.0f, high = _half, angle = share * _half;
    constexpr int steps = 8;
    for (int i = 0; i < steps; ++i) {
        const float beyond = areaTo(angle) - wanted;
        (beyond > 0.0f ? high : low) = angle;
        const float r = boundary(angle);
        const float next = angle - beyond / (r * r);
        angle = next >= low && next <= high ? next : 0.5f * (low + high);
    }
    return angle;
}

vec2 ApertureShape::sample(const vec2& u) const {
    if (isDisk()) return concentricDisk(u) * _scale;
    const float place = u.x * float(_blades);
    const float side = std::min(std::floor(place), float(_blades - 1));
    const float within = 2.0f * std::min(place - side, 1.0f) - 1.0f; // of the side, -1..1
    const float angle = std::copysign(angleOf(std::abs(within)), within);
    const float around = _rotation + (2.0f * side + 1.0f) * _half + angle;
    const float r = std::sqrt(u.y) * boundary(angle);
    return r * vec2(std::cos(around), std::sin(around)) * _scale;
}

} // namespace patina

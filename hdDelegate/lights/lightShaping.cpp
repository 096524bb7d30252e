// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightShaping.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

vec3 normalized(const vec3& v, const vec3& fallback) {
    const float l = glm::length(v);
    return l > 0.0f && std::isfinite(l) ? v / l : fallback;
}

} // namespace

LightShaping::LightShaping(const Light& light, const mat4& toWorld,
                           std::shared_ptr<const IesProfile> profile)
    : _profile(std::move(profile)) {
    _beam.axis = normalized(-vec3(toWorld[2]), _beam.axis);
    vec3 x = vec3(toWorld[0]);
    x -= glm::dot(x, _beam.axis) * _beam.axis;
    _beam.x = normalized(x, std::abs(_beam.axis.x) < 0.9f
                                ? glm::normalize(glm::cross(vec3(1.0f, 0.0f, 0.0f), _beam.axis))
                                : glm::normalize(glm::cross(vec3(0.0f, 1.0f, 0.0f), _beam.axis)));
    _beam.y = glm::cross(_beam.x, _beam.axis); // local y, as the axis is -z
    if (glm::dot(_beam.y, vec3(toWorld[1])) < 0.0f) _beam.y = -_beam.y;

    if (light.shapingFocus > 0.0f) {
        _beam.focus = light.shapingFocus;
        _beam.focusTint = light.shapingFocusTint;
    }
    if (light.shapingConeAuthored && light.shapingConeAngle < 180.0f) {
        _beam.cone = true;
        _beam.coneEnd = std::max(0.0f, light.shapingConeAngle) * (pi / 180.0f);
        _beam.coneStart =
            _beam.coneEnd * (1.0f - std::clamp(light.shapingConeSoftness, 0.0f, 1.0f));
    }
    if (_profile && _profile->empty()) _profile.reset();
    if (_profile) {
        _angleScale = light.iesAngleScale;
        const float mean = _profile->mean();
        if (light.iesNormalize) _profileScale = mean > 0.0f ? 1.0f / mean : 0.0f;
        _level = _profile->peak() * _profileScale;
    }
    _active = _beam.cone || _beam.focus > 0.0f || _profile != nullptr;
}

vec3 LightShaping::factor(const vec3& direction) const {
    if (!_active) return vec3(1.0f);
    const float cosine = shLights::shapingCosine(_beam, direction);
    vec3 result = shLights::shapingBeam(_beam, cosine);
    if (_profile && result != vec3(0.0f)) {
        const float theta = IesProfile::scaledTheta(std::acos(cosine), _angleScale);
        const float phi = shLights::iesAzimuth(_beam.x, _beam.y, direction);
        result *= _profile->candela(theta, phi) * _profileScale;
    }
    return result;
}

} // namespace patina

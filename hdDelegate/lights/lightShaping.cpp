#include "hdDelegate/lights/lightShaping.h"

#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

vec3 normalized(const vec3& v, const vec3& fallback) {
    const float l = glm::length(v);
    return l > 0.0f && std::isfinite(l) ? v / l : fallback;
}

float smoothStep(float low, float high, float x) {
    if (!(high > low)) return x > high ? 1.0f : 0.0f;
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

} // namespace

LightShaping::LightShaping(const Light& light, const mat4& toWorld,
                           std::shared_ptr<const IesProfile> profile)
    : _profile(std::move(profile)) {
    _axis = normalized(-vec3(toWorld[2]), _axis);
    vec3 x = vec3(toWorld[0]);
    x -= glm::dot(x, _axis) * _axis;
    _x = normalized(x, std::abs(_axis.x) < 0.9f
                           ? glm::normalize(glm::cross(vec3(1.0f, 0.0f, 0.0f), _axis))
                           : glm::normalize(glm::cross(vec3(0.0f, 1.0f, 0.0f), _axis)));
    _y = glm::cross(_x, _axis); // local y, as the axis is -z
    if (glm::dot(_y, vec3(toWorld[1])) < 0.0f) _y = -_y;

    if (light.shapingFocus > 0.0f) {
        _focus = light.shapingFocus;
        _focusTint = light.shapingFocusTint;
    }
    if (light.shapingConeAuthored && light.shapingConeAngle < 180.0f) {
        _cone = true;
        _cutoff = std::max(0.0f, light.shapingConeAngle) * (pi / 180.0f);
        _smoothStart = _cutoff * (1.0f - std::clamp(light.shapingConeSoftness, 0.0f, 1.0f));
    }
    if (_profile && _profile->empty()) _profile.reset();
    if (_profile) {
        _angleScale = light.iesAngleScale;
        const float mean = _profile->mean();
        if (light.iesNormalize) _profileScale = mean > 0.0f ? 1.0f / mean : 0.0f;
        _level = _profile->peak() * _profileScale;
    }
    _active = _cone || _focus > 0.0f || _profile != nullptr;
}

vec3 LightShaping::factor(const vec3& direction) const {
    if (!_active) return vec3(1.0f);
    const float cosine = std::clamp(glm::dot(direction, _axis), -1.0f, 1.0f);
    vec3 result(1.0f);
    if (_cone) {
        const float pass = 1.0f - smoothStep(_smoothStart, _cutoff, std::acos(cosine));
        if (pass <= 0.0f) return vec3(0.0f);
        result *= pass;
    }
    if (_focus > 0.0f) {
        const float inside = std::pow(std::abs(cosine), _focus);
        result *= _focusTint + (vec3(1.0f) - _focusTint) * inside;
    }
    if (_profile) {
        // The profile's nadir is the light's axis. Its azimuth is read for the direction in which
        // the light comes in, as Hydra's own Embree renderer does.
        const float theta = IesProfile::scaledTheta(std::acos(cosine), _angleScale);
        const float phi = std::atan2(-glm::dot(direction, _y), -glm::dot(direction, _x));
        result *= _profile->candela(theta, phi) * _profileScale;
    }
    return result;
}

} // namespace patina

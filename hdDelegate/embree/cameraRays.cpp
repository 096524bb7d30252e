#include "hdDelegate/embree/cameraRays.h"

#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

mat4 interpolate(const MotionTransform& transform, float time, const dvec3& origin) {
    const auto& times = transform.times;
    const auto value = [&](size_t i) { return seenFrom(origin, transform.values[i]); };
    if (transform.values.empty()) return seenFrom(origin, dmat4(1.0));
    if (transform.values.size() == 1 || time <= times.front()) return value(0);
    if (time >= times.back()) return value(transform.values.size() - 1);
    const size_t i = std::upper_bound(times.begin(), times.end(), time) - times.begin();
    const float f = (time - times[i - 1]) / (times[i] - times[i - 1]);
    return value(i - 1) * (1.0f - f) + value(i) * f;
}

namespace {

/// Points of the unit disk, equal areas to equal areas (Shirley and Chiu 1997).
/// Fits the aperture to the image as UsdRenderSettings.aspectRatioConformPolicy names it.
vec2 conform(vec2 aperture, float imageAspect, const std::string& policy) {
    const float aspect = aperture.x / aperture.y;
    const bool wider = imageAspect > aspect;
    if (policy == "adjustApertureWidth" || (policy == "expandAperture" && wider) ||
        (policy == "cropAperture" && !wider))
        aperture.x = aperture.y * imageAspect;
    else if (policy == "adjustApertureHeight" || policy == "expandAperture" ||
             policy == "cropAperture")
        aperture.y = aperture.x / imageAspect;
    return aperture;
}

} // namespace

CameraRays::CameraRays(const Camera& camera, const RenderSettings& settings, const dvec3& origin)
    : _camera(camera), _origin(origin) {
    const float shutterOpen = float(camera.shutterOpen), shutterClose = float(camera.shutterClose);
    _shutterOpen = shutterOpen;
    _shutterLength = settings.enableMotionBlur ? std::max(0.0f, shutterClose - shutterOpen) : 0.0f;
    _moves = camera.transform.moves() && _shutterLength > 0.0f;
    _imageSize = vec2(settings.width, settings.height);

    constexpr float apertureUnit = 0.1f; // tenths of a scene unit
    vec2 aperture =
        vec2(std::max(1e-6f, camera.horizontalAperture), std::max(1e-6f, camera.verticalAperture)) *
        apertureUnit;
    const vec2 offset =
        vec2(camera.horizontalApertureOffset, camera.verticalApertureOffset) * apertureUnit;
    const float imageAspect =
        _imageSize.x / _imageSize.y * float(std::max(1e-6, settings.pixelAspectRatio));
    aperture = conform(aperture, imageAspect, settings.aspectRatioConformPolicy);

    const float focalLength = std::max(1e-6f, camera.focalLength) * apertureUnit;
    // An orthographic camera's aperture is in scene units too, as GfCamera has it.
    const float scale = camera.orthographic ? 1.0f : 1.0f / focalLength;
    _windowMin = (offset - 0.5f * aperture) * scale;
    _windowMax = (offset + 0.5f * aperture) * scale;
    _pixelSpread = (_windowMax.x - _windowMin.x) / _imageSize.x;

    _dof = settings.enableDepthOfField && camera.fStop > 0.0f && camera.focusDistance > 0.0f &&
           !camera.orthographic;
    if (_dof) _lensRadius = 0.5f * focalLength / camera.fStop;
    _worldToCamera = glm::inverse(transformAt(0.5f));
}

mat4 CameraRays::transformAt(float time) const {
    return interpolate(_camera.transform, _shutterOpen + time * _shutterLength, _origin);
}

CameraRay CameraRays::ray(vec2 pixel, vec2 lens, float time) const {
    const vec2 s = pixel / _imageSize;
    const vec2 window(_windowMin.x + s.x * (_windowMax.x - _windowMin.x),
                      _windowMax.y + s.y * (_windowMin.y - _windowMax.y));
    vec3 origin(0.0f), direction(window, -1.0f);
    if (_camera.orthographic) {
        origin = vec3(window, 0.0f);
        direction = vec3(0, 0, -1);
    } else if (_dof) {
        origin = vec3(concentricDisk(lens) * _lensRadius, 0.0f);
        direction -= origin / _camera.focusDistance;
    }
    const float length = glm::length(direction);
    direction /= length;

    const mat4 transform = _moves ? transformAt(time) : transformAt(0.0f);
    CameraRay ray;
    ray.origin = vec3(transform * vec4(origin, 1.0f));
    const vec3 worldDirection = mat3(transform) * direction;
    const float scale = glm::length(worldDirection);
    ray.direction = worldDirection / scale;
    const float alongAxis = std::max(1e-6f, -direction.z); // clip distances are along the axis
    ray.near = std::max(0.0f, _camera.clipNear) * scale / alongAxis;
    ray.far = _camera.clipFar * scale / alongAxis;
    for (const vec4& plane : _camera.clippingPlanes) {
        const float d = glm::dot(plane, vec4(origin, 1.0f));
        const float slope = glm::dot(vec3(plane), direction);
        if (slope > 0.0f)
            ray.near = std::max(ray.near, -d / slope * scale);
        else if (slope < 0.0f)
            ray.far = std::min(ray.far, -d / slope * scale);
        else if (d < 0.0f)
            ray.far = 0.0f;
    }
    ray.time = time;
    if (_camera.orthographic)
        ray.coneWidth = _pixelSpread;
    else
        ray.coneSpread = _pixelSpread;
    return ray;
}

float CameraRays::windowDepth(const vec3& p) const {
    const float n = _camera.clipNear, f = _camera.clipFar, z = -p.z;
    if (_camera.orthographic) return std::clamp((z - n) / (f - n), 0.0f, 1.0f);
    return z <= 0.0f ? 0.0f : std::clamp(f * (z - n) / (z * (f - n)), 0.0f, 1.0f);
}

} // namespace patina

#include "hdDelegate/raster/scene/rasterCamera.h"

#include "hdDelegate/scene/lightUnits.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// Fits the aperture to the image as UsdRenderSettings.aspectRatioConformPolicy names it.
vec2 conform(vec2 aperture, float imageAspect, const std::string& policy) {
    const bool wider = imageAspect > aperture.x / aperture.y;
    if (policy == "adjustApertureWidth" || (policy == "expandAperture" && wider) ||
        (policy == "cropAperture" && !wider))
        aperture.x = aperture.y * imageAspect;
    else if (policy == "adjustApertureHeight" || policy == "expandAperture" ||
             policy == "cropAperture")
        aperture.y = aperture.x / imageAspect;
    return aperture;
}

vec2 disk(vec2 u) {
    const float r = std::sqrt(u.x), phi = 6.2831853f * u.y;
    return {r * std::cos(phi), r * std::sin(phi)};
}

} // namespace

RasterCamera::RasterCamera(const Camera& camera, const RenderSettings& settings)
    : _camera(camera), _imageSize(settings.width, settings.height) {
    constexpr float unit = 0.1f; // tenths of a scene unit
    const float open = float(camera.shutterOpen), close = float(camera.shutterClose);
    _shutterOpen = open;
    _shutterLength = settings.enableMotionBlur ? std::max(0.0f, close - open) : 0.0f;
    vec2 aperture(std::max(1e-6f, camera.horizontalAperture),
                  std::max(1e-6f, camera.verticalAperture));
    const float aspect =
        _imageSize.x / _imageSize.y * float(std::max(1e-6, settings.pixelAspectRatio));
    aperture = conform(aperture * unit, aspect, settings.aspectRatioConformPolicy);
    const vec2 offset = vec2(camera.horizontalApertureOffset, camera.verticalApertureOffset) * unit;
    const float focal = std::max(1e-6f, camera.focalLength) * unit;
    const float scale = camera.orthographic ? 1.0f : 1.0f / focal;
    _windowMin = (offset - 0.5f * aperture) * scale;
    _windowMax = (offset + 0.5f * aperture) * scale;
    if (settings.enableDepthOfField && camera.fStop > 0.0f && camera.focusDistance > 0.0f &&
        !camera.orthographic)
        _lensRadius = 0.5f * focal / camera.fStop;
    _worldToCamera = glm::inverse(transformAt(camera.transform, timeCode(0.5f)));
}

RasterView RasterCamera::view(vec2 offset, vec2 lens, float time, const vec3& low, const vec3& high,
                              int border) const {
    RasterView v;
    const mat4 toWorld = transformAt(_camera.transform, timeCode(time));
    const mat4 toCamera = glm::inverse(toWorld);
    float nearest = INFINITY, farthest = 0.0f;
    for (int i = 0; i < 8; ++i) {
        const vec3 corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        const float z = -(toCamera * vec4(corner, 1.0f)).z;
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
    }
    float n = std::max(_camera.clipNear, 0.98f * nearest);
    float f = std::min(_camera.clipFar, 1.02f * farthest);
    if (!_camera.orthographic) n = std::max(n, 1e-6f);
    if (!(f > n * 1.0001f)) f = n * 1.0001f + 1e-3f;

    const vec2 pixel = (_windowMax - _windowMin) / _imageSize;
    const vec2 shift = vec2(offset.x, -offset.y) * pixel;
    const vec2 beside = float(border) * pixel;
    vec2 lo = _windowMin + shift - beside, hi = _windowMax + shift + beside;
    mat4 lensShift(1.0f);
    if (_camera.orthographic) {
        v.worldToClip = glm::ortho(lo.x, hi.x, lo.y, hi.y, n, f) * toCamera;
    } else {
        // A point of the lens sees the plane in focus through the same window.
        vec2 at(0.0f);
        if (_lensRadius > 0.0f) at = disk(lens) * _lensRadius;
        if (_lensRadius > 0.0f) {
            lo -= at / _camera.focusDistance;
            hi -= at / _camera.focusDistance;
        }
        lensShift = glm::translate(mat4(1.0f), vec3(-at, 0.0f));
        v.worldToClip =
            glm::frustum(lo.x * n, hi.x * n, lo.y * n, hi.y * n, n, f) * lensShift * toCamera;
        v.eye = vec3(toWorld * vec4(at, 0.0f, 1.0f));
    }
    v.clipToWorld = glm::inverse(v.worldToClip);
    v.perspective = !_camera.orthographic;
    v.forward = -glm::normalize(vec3(toWorld[2]));
    v.pixelSpread = pixel.x;
    const float own = std::min(n, std::max(_camera.clipNear, 0.0f));
    v.fitted = n - own;
    v.reach = std::max(_camera.clipFar - own, 0.0f);
    for (const vec4& plane : _camera.clippingPlanes)
        v.planes.push_back(glm::transpose(toCamera) * plane);
    return v;
}

float RasterCamera::blurAt(float distance) const {
    if (!(_lensRadius > 0.0f)) return 0.0f;
    return _lensRadius * std::fabs(distance / _camera.focusDistance - 1.0f);
}

float RasterCamera::windowDepth(const vec3& p) const {
    const float n = _camera.clipNear, f = _camera.clipFar, z = -p.z;
    if (_camera.orthographic) return std::clamp((z - n) / (f - n), 0.0f, 1.0f);
    return z <= 0.0f ? 0.0f : std::clamp(f * (z - n) / (z * (f - n)), 0.0f, 1.0f);
}

} // namespace patina

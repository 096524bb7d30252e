// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/cameraRays.h"

#include "hdDelegate/embree/surfaceSpace.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

CameraRays::CameraRays(const Camera& camera, const RenderSettings& settings, const dvec3& origin,
                       std::shared_ptr<const DistortionMap> distortion)
    : _camera(camera), _frame(camera, settings), _origin(origin),
      _moves(camera.transform.moves() && _frame.shutterLength > 0.0f),
      _pixelSpread(_frame.pixelSpread()), _motion(camera, _frame) {
    _worldToCamera = glm::inverse(transformAt(0.5f));
    if (LensRays::needed(camera.lens)) _lens.emplace(camera, _frame, std::move(distortion));
}

mat4 CameraRays::transformAt(float time) const {
    return interpolate(_camera.transform, _frame.timeCode(time), _origin);
}

CameraRay CameraRays::ray(vec2 pixel, vec2 lens, float time, vec2 within) const {
    const vec2 s = pixel / _frame.imageSize, low = _frame.windowMin, high = _frame.windowMax;
    const vec2 window(low.x + s.x * (high.x - low.x), high.y + s.y * (low.y - high.y));
    vec3 origin(0.0f), direction(window, -1.0f);
    float behind = 0.0f;
    if (_lens) {
        const LensRay own = _lens->ray(pixel, lens, within);
        if (!own.seen) {
            CameraRay none;
            none.seen = false;
            return none;
        }
        origin = own.origin;
        direction = own.direction;
    } else if (_camera.orthographic) {
        behind = std::max(0.0f, -_camera.clipNear); // rays have no part before their origin
        origin = vec3(window, behind);
        direction = vec3(0, 0, -1);
    } else if (_frame.lensRadius > 0.0f) {
        origin = vec3(concentricDisk(lens) * _frame.lensRadius, 0.0f);
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
    // Clip distances are along the axis, where there is a plane to measure them from.
    const float alongAxis = _frame.radial ? 1.0f : std::max(1e-6f, -direction.z);
    ray.near = std::max(0.0f, _camera.clipNear) * scale / alongAxis;
    ray.far = (_camera.clipFar + behind) * scale / alongAxis;
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
    if (_frame.orthographic)
        ray.coneWidth = _pixelSpread;
    else
        ray.coneSpread = _pixelSpread;
    return ray;
}

} // namespace patina

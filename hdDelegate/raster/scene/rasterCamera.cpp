// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterCamera.h"

#include "hdDelegate/scene/lightUnits.h"
#include "base/maths.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

vec2 disk(vec2 u) {
    const float r = std::sqrt(u.x), phi = 2.0f * pi * u.y;
    return {r * std::cos(phi), r * std::sin(phi)};
}

} // namespace

Camera rasterizedCamera(Camera camera, Diagnostics& diagnostics) {
    CameraLens& lens = camera.lens;
    const auto leaveOut = [&](const char* input, bool drawn, auto& value) {
        if (drawn) return;
        diagnostics.warn(camera.path, input, messages::notInRaster);
        value = {};
    };
    leaveOut("patina:projection", lens.standard(), lens.projection);
    leaveOut("patina:distortionMap", lens.distortionMap.empty(), lens.distortionMap);
    leaveOut("patina:distortionK1", lens.distortionK1 == 0.0f, lens.distortionK1);
    leaveOut("patina:distortionK2", lens.distortionK2 == 0.0f, lens.distortionK2);
    const bool oneEye = lens.stereo == StereoView::Left || lens.stereo == StereoView::Right;
    leaveOut("patina:stereo", lens.stereo == StereoView::Mono || (oneEye && !camera.orthographic),
             lens.stereo);
    return camera;
}

RasterCamera::RasterCamera(const Camera& camera, const RenderSettings& settings)
    : _camera(camera), _frame(camera, settings), _aperture(camera.lens) {
    const float half = 0.5f * camera.lens.interocularDistance;
    if (camera.lens.stereo == StereoView::Left) _eye = -half;
    if (camera.lens.stereo == StereoView::Right) _eye = half;
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

    const vec2 pixel = (_frame.windowMax - _frame.windowMin) / _frame.imageSize;
    const vec2 shift = vec2(offset.x, -offset.y) * pixel;
    const vec2 beside = float(border) * pixel;
    vec2 lo = _frame.windowMin + shift - beside, hi = _frame.windowMax + shift + beside;
    mat4 lensShift(1.0f);
    if (_camera.orthographic) {
        v.worldToClip = glm::ortho(lo.x, hi.x, lo.y, hi.y, n, f) * toCamera;
    } else {
        // A point of the lens sees the plane in focus through the same window.
        vec2 at(0.0f);
        if (_frame.lensRadius > 0.0f)
            at = (_aperture.isDisk() ? disk(lens) * _aperture.scale() : _aperture.sample(lens)) *
                 _frame.lensRadius;
        if (_frame.lensRadius > 0.0f) {
            lo -= at / _camera.focusDistance;
            hi -= at / _camera.focusDistance;
        }
        if (_eye != 0.0f) {
            const float convergence = _camera.lens.convergenceDistance;
            const float seen = convergence > 0.0f ? _eye / convergence : 0.0f;
            lo.x -= seen;
            hi.x -= seen;
            at.x += _eye;
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
    if (!(_frame.lensRadius > 0.0f)) return 0.0f;
    return _frame.lensRadius * std::max(_aperture.scale().x, 1.0f) *
           std::fabs(distance / _camera.focusDistance - 1.0f);
}

} // namespace patina

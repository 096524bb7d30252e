// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/lensRays.h"

#include <algorithm>
#include <cmath>

namespace patina {

LensRays::LensRays(const Camera& camera, const CameraFrame& frame,
                   std::shared_ptr<const DistortionMap> distortion)
    : _lens(camera.lens), _frame(frame), _distortion(std::move(distortion)), _aperture(camera.lens),
      _project(projectOf(camera.lens, frame.orthographic)), _fields(camera.lens.fieldsOfView()),
      _towards(_lens.convergenceDistance > 0.0f ? 1.0f / _lens.convergenceDistance : 0.0f) {}

LensRays::Project LensRays::projectOf(const CameraLens& lens, bool orthographic) {
    if (lens.fisheye()) return &LensRays::fisheye;
    if (lens.projection == LensProjection::Cylindrical) return &LensRays::cylindrical;
    if (lens.projection == LensProjection::Spherical) return &LensRays::spherical;
    return orthographic ? &LensRays::orthographic : &LensRays::perspective;
}

vec2 LensRays::window(const vec2& place) const {
    const vec2 low = _frame.windowMin, high = _frame.windowMax;
    return {low.x + place.x * (high.x - low.x), high.y + place.y * (low.y - high.y)};
}

LensRays::View LensRays::perspective(const vec2& place) const {
    View view;
    view.direction = vec3(window(place), -1.0f);
    return view;
}

LensRays::View LensRays::orthographic(const vec2& place) const {
    View view;
    view.origin = vec3(window(place), 0.0f);
    return view;
}

LensRays::View LensRays::cylindrical(const vec2& place) const {
    const float longitude = (place.x - 0.5f) * _fields.x;
    const float height = (1.0f - 2.0f * place.y) * std::tan(0.5f * _fields.y);
    const float length = std::sqrt(1.0f + height * height);
    const float s = std::sin(longitude), c = std::cos(longitude);
    View view;
    view.direction = vec3(s, height, -c) / length;
    view.right = vec3(c, 0.0f, s);
    view.up = glm::cross(view.right, view.direction);
    return view;
}

LensRays::View LensRays::spherical(const vec2& place) const {
    const float longitude = (place.x - 0.5f) * _fields.x, latitude = (0.5f - place.y) * _fields.y;
    const float s = std::sin(longitude), c = std::cos(longitude);
    View view;
    view.direction = vec3(s * std::cos(latitude), std::sin(latitude), -c * std::cos(latitude));
    view.right = vec3(c, 0.0f, s);
    view.up = glm::cross(view.right, view.direction);
    return view;
}

float LensRays::angleOf(float radius) const {
    const float half = 0.5f * _fields.x;
    switch (_lens.projection) {
    case LensProjection::FisheyeEquisolid:
        return 2.0f * std::asin(std::min(radius * std::sin(0.5f * half), 1.0f));
    case LensProjection::FisheyeStereographic:
        return 2.0f * std::atan(radius * std::tan(0.5f * half));
    default: return radius * half;
    }
}

LensRays::View LensRays::fisheye(const vec2& place) const {
    const vec2 size = _frame.windowMax - _frame.windowMin;
    const vec2 p = window(place) / (0.5f * std::min(size.x, size.y));
    const float radius = glm::length(p);
    View view;
    view.seen = radius <= 1.0f;
    if (!view.seen || radius == 0.0f) return view;
    const float angle = angleOf(radius);
    const float s = std::sin(angle), c = std::cos(angle);
    const vec2 out = p / radius;
    view.direction = vec3(out * s, -c);
    // The camera's own frame, turned about the axis that is across both.
    const vec3 along(out * c, s), across(-out.y, out.x, 0.0f);
    view.right = out.x * along - out.y * across;
    view.up = out.y * along + out.x * across;
    return view;
}

/// @param corner receives where the eye's part begins, in parts
/// @returns -1 for the left eye, 1 for the right one, 0 for both
float LensRays::sideOf(const vec2& within, vec2& corner) const {
    corner = vec2(0.0f);
    switch (_lens.stereo) {
    case StereoView::Mono: return 0.0f;
    case StereoView::Left: return -1.0f;
    case StereoView::Right: return 1.0f;
    case StereoView::SideBySide: corner.x = within.x >= _frame.eyeSize.x ? 1.0f : 0.0f; break;
    case StereoView::OverUnder: corner.y = within.y >= _frame.eyeSize.y ? 1.0f : 0.0f; break;
    }
    return corner.x + corner.y > 0.0f ? 1.0f : -1.0f;
}

LensRay LensRays::ray(vec2 pixel, vec2 lens, vec2 within) const {
    vec2 corner;
    const float side = sideOf(within, corner);
    vec2 place = pixel / _frame.eyeSize - corner;
    if (_distortion) place = _distortion->shown(place);
    if (_lens.distortionK1 != 0.0f || _lens.distortionK2 != 0.0f) {
        const vec2 size = _frame.windowMax - _frame.windowMin, out = (place - 0.5f) * size;
        const float r2 = glm::dot(out, out) / (0.25f * glm::dot(size, size));
        place =
            0.5f + (place - 0.5f) * (1.0f + r2 * (_lens.distortionK1 + r2 * _lens.distortionK2));
    }
    View view;
    constexpr float farthest = 1e6f; // films; what is not finite is not less, either
    view.seen = std::abs(place.x) + std::abs(place.y) < farthest;
    if (view.seen) view = (this->*_project)(place);
    LensRay ray;
    ray.seen = view.seen;
    if (!ray.seen) return ray;
    // An eye beside the middle sees what both look at through the same place of the film. All
    // around, it goes round the middle: Ishiguro et al. 1992, omni-directional stereo.
    const vec3 eye = view.right * (0.5f * side * _lens.interocularDistance);
    ray.origin = view.origin + eye;
    ray.direction = view.direction - eye * _towards;
    if (_frame.lensRadius > 0.0f) {
        const vec2 at = _aperture.sample(lens) * _frame.lensRadius;
        const vec3 shift = view.right * at.x + view.up * at.y;
        ray.origin += shift;
        ray.direction -= shift / _frame.focusDistance;
    }
    return ray;
}

} // namespace patina

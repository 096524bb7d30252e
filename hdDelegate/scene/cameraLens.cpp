// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/cameraLens.h"

#include "hdDelegate/scene/camera.h"

#include <cmath>
#include <tuple>

namespace patina {

namespace {

auto values(const CameraLens& l) {
    return std::tie(l.projection, l.fieldOfView, l.verticalFieldOfView, l.apertureBlades,
                    l.apertureBladeCurvature, l.apertureRotation, l.apertureAspect, l.stereo,
                    l.interocularDistance, l.convergenceDistance, l.distortionMap, l.distortionK1,
                    l.distortionK2);
}

} // namespace

bool CameraLens::operator==(const CameraLens& other) const {
    return values(*this) == values(other);
}

vec2 CameraLens::fieldsOfView() const {
    vec2 own(180.0f);
    if (projection == LensProjection::Spherical) own = vec2(360.0f, 180.0f);
    if (projection == LensProjection::Cylindrical) own = vec2(360.0f, 90.0f);
    if (fieldOfView > 0.0f) own.x = fieldOfView;
    if (fisheye()) own.y = own.x;
    if (verticalFieldOfView > 0.0f && !fisheye()) own.y = verticalFieldOfView;
    return glm::radians(own);
}

bool needsRays(const Camera& camera) {
    const CameraLens& lens = camera.lens;
    const bool oneEye = lens.stereo == StereoView::Left || lens.stereo == StereoView::Right;
    return !lens.standard() || !lens.distortionMap.empty() || lens.distortionK1 != 0.0f ||
           lens.distortionK2 != 0.0f ||
           !(lens.stereo == StereoView::Mono || (oneEye && !camera.orthographic));
}

double imageAspect(const Camera& camera) {
    const CameraLens& lens = camera.lens;
    double aspect = camera.horizontalAperture > 0.0f && camera.verticalAperture > 0.0f
                        ? double(camera.horizontalAperture) / double(camera.verticalAperture)
                        : 16.0 / 9.0;
    const vec2 fields = lens.fieldsOfView();
    if (lens.projection == LensProjection::Spherical) aspect = double(fields.x) / double(fields.y);
    if (lens.projection == LensProjection::Cylindrical)
        aspect = double(fields.x) / (2.0 * std::tan(0.5 * double(fields.y)));
    if (lens.stereo == StereoView::SideBySide) aspect *= 2.0;
    if (lens.stereo == StereoView::OverUnder) aspect *= 0.5;
    return aspect;
}

} // namespace patina

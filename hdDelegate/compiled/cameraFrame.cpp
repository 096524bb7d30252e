// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/cameraFrame.h"

#include "hdDelegate/scene/lightUnits.h"

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

/// How much of the image one eye has.
vec2 shareOf(StereoView stereo) {
    if (stereo == StereoView::SideBySide) return {0.5f, 1.0f};
    if (stereo == StereoView::OverUnder) return {1.0f, 0.5f};
    return vec2(1.0f);
}

/// The smallest angle that a pixel covers anywhere on a film that is no plane.
/// @param window width and height of the film in any unit
float smallestAngle(const CameraLens& lens, const vec2& window, const vec2& pixels) {
    const vec2 fields = lens.fieldsOfView();
    const float half = 0.5f * fields.x;
    // The size of a pixel, in radii of a fisheye's circle, which spans half of the field.
    const float step = (window.x / pixels.x) / (0.5f * std::min(window.x, window.y));
    switch (lens.projection) {
    case LensProjection::FisheyeEquidistant: return half * step;
    case LensProjection::FisheyeEquisolid: return 2.0f * std::sin(0.5f * half) * step; // middle
    case LensProjection::FisheyeStereographic: return std::sin(half) * step;           // edge
    case LensProjection::Cylindrical: // at the upper edge
        return std::min(fields.x / pixels.x, std::sin(fields.y) / pixels.y);
    default: return std::min(fields.x / pixels.x, fields.y / pixels.y);
    }
}

double largest(const dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

} // namespace

CameraFrame::CameraFrame(const Camera& camera, const RenderSettings& settings)
    : imageSize(settings.width, settings.height), focusDistance(camera.focusDistance),
      shutterOpen(shutterOf(camera, settings).x), clipNear(camera.clipNear),
      clipFar(camera.clipFar), orthographic(camera.orthographic && camera.lens.standard()),
      radial(!camera.lens.standard()) {
    constexpr float unit = 0.1f; // tenths of a scene unit
    shutterLength = shutterOf(camera, settings).y - shutterOpen;
    vec2 aperture(std::max(1e-6f, camera.horizontalAperture),
                  std::max(1e-6f, camera.verticalAperture));
    const vec2 offset = vec2(camera.horizontalApertureOffset, camera.verticalApertureOffset) * unit;
    eyeSize = imageSize * shareOf(camera.lens.stereo);
    const PixelWindow& frame = settings.frameWindow;
    const bool overscan = frame[2] >= frame[0] && frame[3] >= frame[1] && camera.lens.hasOverscan();
    const vec2 frameSize =
        overscan ? vec2(float(frame[2]) - frame[0], float(frame[3]) - frame[1]) + 1.0f : eyeSize;
    const float aspect =
        frameSize.x / frameSize.y * float(std::max(1e-6, settings.pixelAspectRatio));
    aperture = conform(aperture * unit, aspect, settings.aspectRatioConformPolicy);
    const float focal = std::max(1e-6f, camera.focalLength) * unit;
    // An orthographic camera's aperture is in scene units too, as GfCamera has it.
    const float scale = orthographic ? 1.0f : 1.0f / focal;
    windowMin = (offset - 0.5f * aperture) * scale;
    windowMax = (offset + 0.5f * aperture) * scale;
    if (overscan) { // pixels count from the upper left
        const vec2 pixel = (windowMax - windowMin) / frameSize;
        windowMin.x -= float(frame[0]) * pixel.x;
        windowMax.y += float(frame[1]) * pixel.y;
        windowMax.x = windowMin.x + imageSize.x * pixel.x;
        windowMin.y = windowMax.y - imageSize.y * pixel.y;
    }
    if (settings.enableDepthOfField && camera.fStop > 0.0f && focusDistance > 0.0f && !orthographic)
        lensRadius = 0.5f * focal / camera.fStop;
    _pixelSpread = radial ? smallestAngle(camera.lens, windowMax - windowMin, eyeSize)
                          : (windowMax.x - windowMin.x) / eyeSize.x;
}

float CameraFrame::windowDepth(const vec3& p) const {
    const float z = depthOf(p);
    if (orthographic) return std::clamp((z - clipNear) / (clipFar - clipNear), 0.0f, 1.0f);
    if (z <= 0.0f) return 0.0f;
    return std::clamp(clipFar * (z - clipNear) / (z * (clipFar - clipNear)), 0.0f, 1.0f);
}

vec2 shutterOf(const Camera& camera, const RenderSettings& settings) {
    const bool opens = settings.enableMotionBlur && camera.shutterClose > camera.shutterOpen;
    return opens ? vec2(camera.shutterOpen, camera.shutterClose) : vec2(0.0f);
}

dvec3 cameraPlace(const Camera& camera, const RenderSettings& settings) {
    const CameraFrame frame(camera, settings);
    return dvec3(exactTransformAt(camera.transform, frame.timeCode(0.5f))[3]);
}

ScreenScale screenScale(const Camera& camera, const RenderSettings& settings, const dvec3& origin) {
    const CameraFrame frame(camera, settings);
    return {vec3(cameraPlace(camera, settings) - origin), !frame.orthographic, frame.pixelSpread(),
            camera.clipNear, double(settings.width) * settings.height};
}

dvec3 originNear(const dvec3& middle, double size, double far, double cell) {
    const double away = largest(middle);
    if (!(size > 0.0) || !std::isfinite(size) || !std::isfinite(away) || away <= far * size)
        return dvec3(0.0);
    const double grid = std::exp2(std::ceil(std::log2(cell * size)));
    const dvec3 origin = glm::round(middle / grid) * grid;
    return std::isfinite(largest(origin)) ? origin : dvec3(0.0);
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/cameraInputs.h"

#include <cmath>
#include <functional>
#include <sstream>

namespace patina {

namespace {

constexpr int maxBlades = 64;

/// Takes a value into a lens. @returns an empty text, or why it cannot
using Take = std::function<std::string(const MarkValue&, CameraLens&)>;

struct InputRow {
    const char* name;
    Take take;
};

std::string shortNumber(float x) {
    std::ostringstream text;
    text << x;
    return text.str();
}

std::string numberWithin(const MarkValue& value, float low, float high, float& number) {
    const double* given = std::get_if<double>(&value);
    if (!given || !(*given >= double(low) && *given <= double(high)))
        return "is no number from " + shortNumber(low) + " to " + shortNumber(high);
    number = float(*given);
    return "";
}

template <class T>
std::string oneOf(const std::map<std::string, T>& known, const MarkValue& value, T& to) {
    const std::string* text = std::get_if<std::string>(&value);
    const auto found = text ? known.find(*text) : known.end();
    if (found != known.end()) {
        to = found->second;
        return "";
    }
    std::string names;
    for (const auto& item : known)
        names += (names.empty() ? "" : ", ") + item.first;
    return (text ? "is '" + *text + "', not one of " : "is no text: one of ") + names;
}

Take Number(float CameraLens::*field, float low, float high) {
    return [=](const MarkValue& value, CameraLens& lens) {
        return numberWithin(value, low, high, lens.*field);
    };
}

Take OfFisheye(float CameraLens::*field, float low, float high) {
    return [=](const MarkValue& value, CameraLens& lens) {
        return lens.fisheye() ? numberWithin(value, low, high, lens.*field) : std::string();
    };
}

Take File(std::string CameraLens::*field) {
    return [=](const MarkValue& value, CameraLens& lens) -> std::string {
        const std::string* text = std::get_if<std::string>(&value);
        if (!text) return "names no file";
        lens.*field = *text;
        return "";
    };
}

std::string Blades(const MarkValue& value, CameraLens& lens) {
    float number = 0.0f;
    const std::string problem = numberWithin(value, 0.0f, float(maxBlades), number);
    if (problem.empty()) lens.apertureBlades = int(std::round(number));
    return problem;
}

std::string Projection(const MarkValue& value, CameraLens& lens) {
    static const std::map<std::string, LensProjection> names = {
        {"standard", LensProjection::Standard},
        {"perspective", LensProjection::Standard},
        {"orthographic", LensProjection::Standard},
        {"fisheye", LensProjection::FisheyeEquidistant},
        {"fisheyeEquidistant", LensProjection::FisheyeEquidistant},
        {"fisheyeEquisolid", LensProjection::FisheyeEquisolid},
        {"fisheyeStereographic", LensProjection::FisheyeStereographic},
        {"cylindrical", LensProjection::Cylindrical},
        {"spherical", LensProjection::Spherical}};
    return oneOf(names, value, lens.projection);
}

std::string Stereo(const MarkValue& value, CameraLens& lens) {
    static const std::map<std::string, StereoView> names = {{"mono", StereoView::Mono},
                                                            {"left", StereoView::Left},
                                                            {"right", StereoView::Right},
                                                            {"sideBySide", StereoView::SideBySide},
                                                            {"overUnder", StereoView::OverUnder}};
    return oneOf(names, value, lens.stereo);
}

std::string ArnoldCamera(const MarkValue& value, CameraLens& lens) {
    static const std::map<std::string, LensProjection> names = {
        {"persp_camera", LensProjection::Standard},
        {"ortho_camera", LensProjection::Standard},
        {"fisheye_camera", LensProjection::FisheyeEquidistant},
        {"cyl_camera", LensProjection::Cylindrical},
        {"spherical_camera", LensProjection::Spherical},
        {"vr_camera", LensProjection::Spherical}};
    const std::string problem = oneOf(names, value, lens.projection);
    if (problem.empty() && std::get<std::string>(value) == "vr_camera")
        lens.stereo = StereoView::SideBySide;
    return problem;
}

std::string ArnoldStereo(const MarkValue& value, CameraLens& lens) {
    static const std::map<std::string, StereoView> names = {
        {"side_by_side", StereoView::SideBySide},
        {"over_under", StereoView::OverUnder},
        {"left_eye", StereoView::Left},
        {"right_eye", StereoView::Right}};
    return oneOf(names, value, lens.stereo);
}

const std::vector<InputRow>& rows() {
    static const std::vector<InputRow> made = {
#define CAMERA_INPUT(name, take, ...) {name, take},
#include "hdDelegate/scene/cameraInputs.def"
#undef CAMERA_INPUT
    };
    return made;
}

/// Inputs that contradict each other, though each is sound by itself.
void checkTogether(CameraLens& lens, const std::string& path, Diagnostics& diagnostics) {
    constexpr float widestCylinder = 179.0f, widestStereographic = 340.0f; // degrees
    const auto limit = [&](const char* input, float& value, float most) {
        if (value <= most) return;
        diagnostics.warn(path, input, messages::fieldOfViewTooWide(shortNumber(most)));
        value = most;
    };
    if (lens.projection == LensProjection::Cylindrical)
        limit("patina:verticalFieldOfView", lens.verticalFieldOfView, widestCylinder);
    if (lens.projection == LensProjection::FisheyeStereographic)
        limit("patina:fieldOfView", lens.fieldOfView, widestStereographic);
    if (lens.stereo != StereoView::Mono && lens.interocularDistance == 0.0f)
        diagnostics.warn(path, "patina:interocularDistance", messages::eyesAlike);
}

} // namespace

std::vector<std::string> cameraInputNames() {
    std::vector<std::string> names;
    for (const InputRow& row : rows())
        names.emplace_back(row.name);
    return names;
}

void applyCameraInputs(const Marks& inputs, Camera& camera, Diagnostics& diagnostics) {
    if (inputs.empty()) return;
    for (const InputRow& row : rows()) {
        const auto found = inputs.find(row.name);
        if (found == inputs.end()) continue;
        const std::string problem = row.take(found->second, camera.lens);
        if (!problem.empty())
            diagnostics.warn(camera.path, row.name, messages::cameraAttributeLeftOut(problem));
    }
    checkTogether(camera.lens, camera.path, diagnostics);
}

} // namespace patina

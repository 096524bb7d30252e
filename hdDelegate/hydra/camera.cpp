// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/camera.h"

#include "hdDelegate/hydra/marks.h"
#include "hdDelegate/hydra/sampling.h"
#include "hdDelegate/hydra/values.h"
#include "hdDelegate/scene/cameraInputs.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <pxr/imaging/hd/cameraSchema.h>
#include <pxr/imaging/hd/changeTracker.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/sceneIndex.h>

#include <cmath>

namespace patina {

namespace {

/// Hydra gives lengths in scene units, made from tenths of them.
/// @returns the authored number, so that both hosts trace the very same rays
float authored(float sceneUnits, double unit) {
    const float factor = float(unit), guess = float(double(sceneUnits) / unit);
    for (const float x : {guess, std::nextafter(guess, -INFINITY), std::nextafter(guess, INFINITY)})
        if (x * factor == sceneUnits) return x;
    return guess;
}

/// HdCamera takes what it does not know for orthographic; scene indices still have the name.
/// @returns false, after a warning, for what is neither of the two
bool knowsProjection(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id) {
    const HdSceneIndexBaseRefPtr scene = delegate.GetRenderIndex().GetTerminalSceneIndex();
    if (!scene) return true;
    HdCameraSchema camera = HdCameraSchema::GetFromParent(scene->GetPrim(id).dataSource);
    const HdTokenDataSourceHandle source = camera ? camera.GetProjection() : nullptr;
    if (!source) return true;
    const std::string name = source->GetTypedValue(0.0f).GetString();
    if (name == "perspective" || name == "orthographic") return true;
    param.warn(id, "projection", messages::projectionUnknown(name));
    return false;
}

/// Nothing is seen under a transform without an inverse.
MotionTransform placeOf(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id) {
    const MotionTransform transform = transformOf(delegate, param, id);
    for (const dmat4& m : transform.values) {
        const float volume = glm::determinant(mat3(mat4(m)));
        if (std::isfinite(volume) && volume != 0.0f) continue;
        param.warn(id, "transform", messages::transformUnused(inverseProblem(m)));
        return mat4(1.0f);
    }
    return transform;
}

/// The lens of cameraInputs.def; a name of its own is stronger than a primvar.
void readInputs(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                Camera& camera) {
    Marks inputs;
    for (const std::string& name : cameraInputNames())
        for (const char* prefix : {"primvars:", ""}) {
            const VtValue value = delegate.GetCameraParamValue(id, TfToken(prefix + name));
            MarkValue input;
            if (markOf(value, input)) inputs[name] = input;
        }
    applyCameraInputs(inputs, camera, param.scene()->diagnostics());
}

} // namespace

void HdPatinaCamera::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
                          HdDirtyBits* dirtyBits) {
    auto& param = *static_cast<HdPatinaRenderParam*>(renderParam);
    HdCamera::Sync(delegate, renderParam, dirtyBits);
    param.widenShutter(GetShutterOpen(), GetShutterClose());
    auto camera = std::make_shared<Camera>();
    camera->path = GetId().GetString();
    _delegate = delegate;
    _shutter = param.shutter();
    camera->transform = placeOf(*delegate, param, GetId());
    camera->orthographic =
        GetProjection() == Orthographic && knowsProjection(*delegate, param, GetId());
    // A camera that has no lens (a host gave matrices) keeps the schema's.
#define PATINA_CAMERA_INPUT(field, key, Getter, unit, positive, fallback, description)             \
    if (!(positive) || Getter() > 0.0f) camera->field = authored(Getter(), unit);
#include "hdDelegate/scene/cameraTypes.inc"
    if (!GetClippingRange().IsEmpty()) {
        camera->clipNear = GetClippingRange().GetMin();
        camera->clipFar = GetClippingRange().GetMax();
    }
    for (const GfVec4d& plane : GetClipPlanes())
        camera->clippingPlanes.emplace_back(plane[0], plane[1], plane[2], plane[3]);
    camera->shutterOpen = GetShutterOpen();
    camera->shutterClose = GetShutterClose();
    if (!(camera->shutterClose >= camera->shutterOpen)) {
        param.warn(GetId(), "shutter:close", messages::shutterCloses);
        camera->shutterOpen = camera->shutterClose = 0.0;
    }
    // Newer releases compute it from ISO, time and f-stop as well.
    double scale = std::exp2(GetExposure());
    numberOf(delegate->GetCameraParamValue(GetId(), TfToken("linearExposureScale")), scale);
    camera->exposureScale = float(scale);
    readInputs(*delegate, param, GetId(), *camera);
    _camera = camera;
    param.set(_camera);
}

void HdPatinaCamera::updateTransform(HdPatinaRenderParam& param) {
    if (!_camera || _shutter == param.shutter()) return;
    _shutter = param.shutter();
    auto camera = std::make_shared<Camera>(*_camera);
    camera->transform = placeOf(*_delegate, param, GetId());
    _camera = camera;
    param.set(_camera);
}

void HdPatinaCamera::Finalize(HdRenderParam* renderParam) {
    static_cast<HdPatinaRenderParam*>(renderParam)->removeCamera(GetId().GetString());
}

} // namespace patina

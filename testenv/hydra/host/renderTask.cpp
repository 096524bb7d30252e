// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/renderTask.h"

#include <pxr/imaging/hd/camera.h>
#include <pxr/imaging/hd/renderBuffer.h>
#include <pxr/imaging/hd/renderDelegate.h>
#include <pxr/imaging/hd/renderIndex.h>

namespace patina {

HostRenderTask::HostRenderTask(HdRenderPassSharedPtr pass, const TfTokenVector& renderTags)
    : HdTask(SdfPath::EmptyPath()), _pass(std::move(pass)), _renderTags(renderTags) {}

void HostRenderTask::Sync(HdSceneDelegate*, HdTaskContext*, HdDirtyBits* dirtyBits) {
    _pass->Sync();
    *dirtyBits = HdChangeTracker::Clean;
}

void HostRenderTask::Prepare(HdTaskContext*, HdRenderIndex* index) {
    if (!_state) _state = index->GetRenderDelegate()->CreateRenderPassState();
    HdRenderPassAovBindingVector bindings = _view.aovs;
    for (HdRenderPassAovBinding& binding : bindings)
        binding.renderBuffer = static_cast<HdRenderBuffer*>(
            index->GetBprim(HdPrimTypeTokens->renderBuffer, binding.renderBufferId));
    const auto* camera =
        static_cast<const HdCamera*>(index->GetSprim(HdPrimTypeTokens->camera, _view.camera));
    _state->SetCamera(camera);
    _state->SetOverrideWindowPolicy(_view.policy);
    _state->SetFraming(_view.framing);
    _state->SetAovBindings(bindings);
    _state->Prepare(index->GetResourceRegistry());
}

void HostRenderTask::Execute(HdTaskContext*) {
    _pass->Execute(_state, _renderTags);
}

} // namespace patina

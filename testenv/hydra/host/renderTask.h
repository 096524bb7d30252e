// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/imaging/hd/renderPass.h>
#include <pxr/imaging/hd/renderPassState.h>
#include <pxr/imaging/hd/task.h>

PXR_NAMESPACE_USING_DIRECTIVE

namespace patina {

/// The one task of the host: it owns the render pass, as Hydra's own render task does, and draws
/// without any graphics API. It is not in the render index.
class HostRenderTask final : public HdTask {
public:
    HostRenderTask(HdRenderPassSharedPtr pass, const TfTokenVector& renderTags);

    /// The buffers that Prepare binds, looked up in the render index each time.
    struct View {
        SdfPath camera;
        CameraUtilFraming framing;
        CameraUtilConformWindowPolicy policy = CameraUtilMatchHorizontally;
        HdRenderPassAovBindingVector aovs;
    };
    void setView(const View& view) { _view = view; }
    void setRenderTags(const TfTokenVector& tags) { _renderTags = tags; }
    bool isConverged() const { return _pass->IsConverged(); }
    const HdRenderPassSharedPtr& pass() const { return _pass; }

    void Sync(HdSceneDelegate* delegate, HdTaskContext* context, HdDirtyBits* dirtyBits) override;
    void Prepare(HdTaskContext* context, HdRenderIndex* index) override;
    void Execute(HdTaskContext* context) override;
    const TfTokenVector& GetRenderTags() const override { return _renderTags; }

private:
    HdRenderPassSharedPtr _pass;
    HdRenderPassStateSharedPtr _state;
    TfTokenVector _renderTags;
    View _view;
};

} // namespace patina

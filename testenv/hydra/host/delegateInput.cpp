// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/sceneInput.h"

#include <pxr/usdImaging/usdImaging/delegate.h>

namespace patina {

namespace {

class DelegateInput final : public SceneInput {
public:
    DelegateInput(HdRenderIndex* index, const UsdStageRefPtr& stage)
        : _index(index), _delegate(index, SdfPath::AbsoluteRootPath()) {
        _delegate.SetUsdDrawModesEnabled(true);
        // Purposes are render tags; these flags would only hide prims from the index.
        _delegate.SetDisplayGuides(true);
        _delegate.SetDisplayProxy(true);
        _delegate.SetDisplayRender(true);
        _delegate.Populate(stage->GetPseudoRoot());
    }

    void update(UsdTimeCode time, int refineLevel) override {
        _delegate.SetRefineLevelFallback(refineLevel);
        _delegate.ApplyPendingUpdates();
        _delegate.SetTime(time);
    }

    void setCamera(const SdfPath& path) override { _delegate.SetCameraForSampling(path); }

    HostHit decode(int primId, int instanceId) override {
        HostHit hit;
        const SdfPath rprim = _index->GetRprimPathFromPrimId(primId);
        if (rprim.IsEmpty()) return hit;
        HdInstancerContext context;
        hit.path = _delegate.GetScenePrimPath(rprim, instanceId, &context);
        if (!context.empty()) {
            hit.instancer = context.front().first;
            hit.index = context.front().second;
        }
        return hit;
    }

private:
    HdRenderIndex* _index;
    UsdImagingDelegate _delegate;
};

} // namespace

std::unique_ptr<SceneInput> makeDelegateInput(HdRenderIndex* index, const UsdStageRefPtr& stage) {
    return std::make_unique<DelegateInput>(index, stage);
}

} // namespace patina

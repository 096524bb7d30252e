// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/sceneInput.h"

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hdsi/legacyDisplayStyleOverrideSceneIndex.h>
#include <pxr/imaging/hdsi/sceneGlobalsSceneIndex.h>
#include <pxr/imaging/hdx/pickTask.h>
#include <pxr/usdImaging/usdImaging/sceneIndices.h>
#include <pxr/usdImaging/usdImaging/stageSceneIndex.h>

namespace patina {

namespace {

class SceneIndexInput final : public SceneInput {
public:
    SceneIndexInput(HdRenderIndex* index, const UsdStageRefPtr& stage) : _index(index) {
        UsdImagingCreateSceneIndicesInfo info;
        const UsdImagingSceneIndices indices = UsdImagingCreateSceneIndices(info);
        _stage = indices.stageSceneIndex;
        _style = HdsiLegacyDisplayStyleOverrideSceneIndex::New(indices.finalSceneIndex);
        _globals = HdsiSceneGlobalsSceneIndex::New(_style);
        _index->InsertSceneIndex(_globals, SdfPath::AbsoluteRootPath());
        _stage->SetStage(stage);
    }

    SceneIndexInput(HdRenderIndex* index, const SceneIndexInput& other)
        : _index(index), _stage(other._stage), _style(other._style), _globals(other._globals) {
        _index->InsertSceneIndex(_globals, SdfPath::AbsoluteRootPath());
    }

    ~SceneIndexInput() override { _index->RemoveSceneIndex(_globals); }

    std::unique_ptr<SceneInput> makeShared(HdRenderIndex* index) const override {
        return std::make_unique<SceneIndexInput>(index, *this);
    }

    void update(UsdTimeCode time, int refineLevel) override {
#if PATINA_HAS_REFINE_FALLBACK
        _style->SetRefineLevelFallback(refineLevel);
#else
        _style->SetRefineLevel({true, refineLevel});
#endif
        _stage->ApplyPendingUpdates();
        _stage->SetTime(time);
    }

    void setCamera(const SdfPath&) override {}

    HostHit decode(int primId, int instanceId) override {
        HostHit hit;
        HdxPickHit pick;
        pick.objectId = _index->GetRprimPathFromPrimId(primId);
        if (pick.objectId.IsEmpty()) return hit;
        _index->GetSceneDelegateAndInstancerIds(pick.objectId, &pick.delegateId, &pick.instancerId);
        pick.instanceIndex = instanceId;
        const HdxPrimOriginInfo origin = HdxPrimOriginInfo::FromPickHit(_index, pick);
        hit.path = origin.GetFullPath();
#if PATINA_HAS_INSTANCER_CONTEXT
        const HdInstancerContext context = origin.ComputeInstancerContext();
        if (!context.empty()) {
            hit.instancer = context.front().first;
            hit.index = context.front().second;
        }
#else // the instancers are not told as paths of the stage
        if (!origin.instancerContexts.empty()) {
            const HdxInstancerContext& context = origin.instancerContexts.front();
            const auto scene = HdPrimOriginSchema(context.instancerPrimOrigin);
            hit.instancer = scene.GetOriginPath(HdPrimOriginSchemaTokens->scenePath);
            hit.index = context.instanceId;
        }
#endif
        return hit;
    }

private:
    HdRenderIndex* _index;
    UsdImagingStageSceneIndexRefPtr _stage;
    HdsiLegacyDisplayStyleOverrideSceneIndexRefPtr _style;
    HdsiSceneGlobalsSceneIndexRefPtr _globals;
};

} // namespace

std::unique_ptr<SceneInput> makeSceneIndexInput(HdRenderIndex* index, const UsdStageRefPtr& stage) {
    return std::make_unique<SceneIndexInput>(index, stage);
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
// Changes to a scene before the delegate sees it.

#include "plugin/hydra/meshLightSceneIndex.h"
#include "plugin/hydra/relinkedLightSceneIndex.h"
#include "plugin/hydra/sourceFormsSceneIndex.h"

#include <pxr/imaging/hd/retainedDataSource.h>
#include <pxr/imaging/hd/sceneIndexPlugin.h>
#include <pxr/imaging/hd/sceneIndexPluginRegistry.h>
#include <pxr/imaging/hdsi/materialPrimvarTransferSceneIndex.h>
#include <pxr/imaging/hdsi/nurbsApproximatingSceneIndex.h>
#include <pxr/imaging/hdsi/renderSettingsFilteringSceneIndex.h>
#if PATINA_HAS_LIGHT_LINKING
#include <pxr/imaging/hdsi/lightLinkingSceneIndex.h>
#endif
#if PATINA_HAS_TET_MESHES
#include <pxr/imaging/hdsi/tetMeshConversionSceneIndex.h>
#endif
#if PATINA_HAS_VELOCITY_MOTION
#include <pxr/imaging/hdsi/velocityMotionResolvingSceneIndex.h>
#endif

PXR_NAMESPACE_OPEN_SCOPE

class HdPatinaSceneIndexPlugin final : public HdSceneIndexPlugin {
public:
    HdPatinaSceneIndexPlugin() = default;

protected:
    HdSceneIndexBaseRefPtr _AppendSceneIndex(const HdSceneIndexBaseRefPtr& input,
                                             const HdContainerDataSourceHandle&) override {
        HdSceneIndexBaseRefPtr scene = input;
#if PATINA_HAS_VELOCITY_MOTION
        // Scene indices hand velocities on, and leave to the renderer what they do to points.
        scene = HdsiVelocityMotionResolvingSceneIndex::New(scene);
#endif
        scene = HdPatinaSourceFormsSceneIndex::New(scene);
        scene = HdsiNurbsApproximatingSceneIndex::New(scene);
#if PATINA_HAS_TET_MESHES
        scene = HdsiTetMeshConversionSceneIndex::New(scene);
#endif
        scene = HdPatinaMeshLightSceneIndex::New(scene);
        // Without it no settings prim is ever active, and no product would be written.
        scene = HdsiRenderSettingsFilteringSceneIndex::New(
            scene, HdRetainedContainerDataSource::New(
                       HdsiRenderSettingsFilteringSceneIndexTokens->namespacePrefixes,
                       HdRetainedTypedSampledDataSource<VtArray<TfToken>>::New(
                           VtArray<TfToken>{TfToken("patina:")})));
#if PATINA_HAS_LIGHT_LINKING
        scene = HdPatinaRelinkedLightSceneIndex::New(scene);
        scene = HdsiLightLinkingSceneIndex::New(scene, nullptr);
#endif
        // Primvars of a material are those of the prims that it is bound to, where these have none.
        return HdsiMaterialPrimvarTransferSceneIndex::New(scene);
    }
};

TF_REGISTRY_FUNCTION(TfType) {
    HdSceneIndexPluginRegistry::Define<HdPatinaSceneIndexPlugin>();
}

TF_REGISTRY_FUNCTION(HdSceneIndexPlugin) {
    constexpr HdSceneIndexPluginRegistry::InsertionPhase phase = 0;
    for (const char* renderer : {"Patina", "Patina GL"})
        HdSceneIndexPluginRegistry::GetInstance().RegisterSceneIndexForRenderer(
            renderer, TfToken("HdPatinaSceneIndexPlugin"), nullptr, phase,
            HdSceneIndexPluginRegistry::InsertionOrderAtStart);
}

PXR_NAMESPACE_CLOSE_SCOPE

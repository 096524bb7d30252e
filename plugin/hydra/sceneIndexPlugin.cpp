// SPDX-License-Identifier: Apache-2.0
// Changes to a scene before the delegate sees it.

#include "plugin/hydra/backPlateLookSceneIndex.h"
#include "plugin/hydra/levelsSceneIndex.h"
#include "plugin/hydra/meshLightSceneIndex.h"
#include "plugin/hydra/relinkedLightSceneIndex.h"
#include "plugin/hydra/renderPassSceneIndex.h"
#include "plugin/hydra/sourceFormsSceneIndex.h"

#include <pxr/imaging/hd/dependencyForwardingSceneIndex.h>
#include <pxr/imaging/hd/retainedDataSource.h>
#include <pxr/imaging/hd/sceneIndexPlugin.h>
#include <pxr/imaging/hd/sceneIndexPluginRegistry.h>
#include <pxr/imaging/hdsi/coordSysPrimSceneIndex.h>
#include <pxr/imaging/hdsi/materialPrimvarTransferSceneIndex.h>
#include <pxr/imaging/hdsi/nurbsApproximatingSceneIndex.h>
#include <pxr/imaging/hdsi/renderSettingsFilteringSceneIndex.h>
#if PATINA_HAS_BACK_PLATES
#include <pxr/imaging/hdsi/backPlateSceneIndex.h>
#endif
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
        // Coordinate systems are bound to any prims; delegates know those of a type of their own.
        // They move with those prims, which scene indices before these two do not know.
        HdSceneIndexBaseRefPtr scene =
            HdDependencyForwardingSceneIndex::New(HdsiCoordSysPrimSceneIndex::New(input));
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

/// What asks for the scene's globals, which are laid over the scene after the first phase.
class HdPatinaGlobalsSceneIndexPlugin final : public HdSceneIndexPlugin {
public:
    HdPatinaGlobalsSceneIndexPlugin() = default;

protected:
    HdSceneIndexBaseRefPtr _AppendSceneIndex(const HdSceneIndexBaseRefPtr& input,
                                             const HdContainerDataSourceHandle&) override {
        HdSceneIndexBaseRefPtr scene = input;
#if PATINA_HAS_BACK_PLATES
        scene = HdPatinaBackPlateLookSceneIndex::New(HdsiBackPlateSceneIndex::New(scene));
#endif
#if PATINA_HAS_LEVELS
        scene = HdPatinaLevelsSceneIndex::New(scene);
#endif
#if PATINA_HAS_RENDER_PASSES
        scene = HdPatinaRenderPassSceneIndex::New(scene);
#endif
        return scene;
    }
};

TF_REGISTRY_FUNCTION(TfType) {
    HdSceneIndexPluginRegistry::Define<HdPatinaSceneIndexPlugin>();
    HdSceneIndexPluginRegistry::Define<HdPatinaGlobalsSceneIndexPlugin>();
}

TF_REGISTRY_FUNCTION(HdSceneIndexPlugin) {
    const char* const plugins[] = {"HdPatinaSceneIndexPlugin", "HdPatinaGlobalsSceneIndexPlugin"};
    for (const char* renderer : {"Patina", "Patina GL"})
        for (HdSceneIndexPluginRegistry::InsertionPhase phase : {0, 1})
            HdSceneIndexPluginRegistry::GetInstance().RegisterSceneIndexForRenderer(
                renderer, TfToken(plugins[phase]), nullptr, phase,
                HdSceneIndexPluginRegistry::InsertionOrderAtStart);
}

PXR_NAMESPACE_CLOSE_SCOPE

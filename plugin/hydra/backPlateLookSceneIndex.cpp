// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/backPlateLookSceneIndex.h"

#if PATINA_HAS_BACK_PLATES

#include "plugin/hydra/overlays.h"

#include <pxr/imaging/hd/cameraSchema.h>
#include <pxr/imaging/hd/materialNodeParameterSchema.h>
#include <pxr/imaging/hd/materialSchema.h>
#include <pxr/imaging/hd/sceneGlobalsSchema.h>
#include <pxr/imaging/hd/sceneIndexPrimView.h>
#include <pxr/imaging/hd/tokens.h>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

template <class T> HdDataSourceBaseHandle parameter(const T& value) {
    return HdMaterialNodeParameterSchema::Builder()
        .SetValue(HdRetainedTypedSampledDataSource<VtValue>::New(VtValue(value)))
        .Build();
}

/// What takes the UsdPreviewSurface of a back plate its reflections.
const HdContainerDataSourceHandle& black() {
    static const HdContainerDataSourceHandle material = [] {
        HdDataSourceBaseHandle nested = HdRetainedContainerDataSource::New(
            TfToken("diffuseColor"), parameter(GfVec3f(0.0f)), TfToken("useSpecularWorkflow"),
            parameter(1), TfToken("specularColor"), parameter(GfVec3f(0.0f)), TfToken("ior"),
            parameter(1.0f));
        for (const char* name : {"parameters", "UsdPreviewSurface", "nodes", "", "material"})
            nested = HdRetainedContainerDataSource::New(TfToken(name), nested);
        return HdContainerDataSource::Cast(nested);
    }();
    return material;
}

HdBackPlateSchema plateOf(const HdSceneIndexBaseRefPtr& input, const SdfPath& plate) {
    if (plate.GetPathElementCount() < 2)
        return HdBackPlateSchema(nullptr); // it has no camera above
    const HdSceneIndexPrim camera = input->GetPrim(plate.GetParentPath());
    if (camera.primType != HdPrimTypeTokens->camera) return HdBackPlateSchema(nullptr);
    return HdCameraSchema::GetFromParent(camera.dataSource)
        .GetBackPlate()
        .Get(plate.GetNameToken());
}

} // namespace

bool HdPatinaBackPlateLookSceneIndex::isPart(const SdfPath& path) const {
    const TfToken& name = path.GetNameToken();
    return (name == HdPrimTypeTokens->mesh || name == HdPrimTypeTokens->material) &&
           bool(plateOf(_GetInputSceneIndex(), path.GetParentPath()));
}

bool HdPatinaBackPlateLookSceneIndex::isShown(const SdfPath& mesh) const {
    const SdfPath plate = mesh.GetParentPath();
    const auto visibility = plateOf(_GetInputSceneIndex(), plate).GetPlateVisibility();
    const TfToken shown = visibility ? visibility->GetTypedValue(0.0f) : TfToken("solo");
    if (shown != "solo") return shown == "all";
    const auto camera =
        HdSceneGlobalsSchema::GetFromSceneIndex(_GetInputSceneIndex()).GetPrimaryCameraPrim();
    return camera && camera->GetTypedValue(0.0f) == plate.GetParentPath();
}

HdSceneIndexPrim HdPatinaBackPlateLookSceneIndex::GetPrim(const SdfPath& path) const {
    HdSceneIndexPrim prim = _GetInputSceneIndex()->GetPrim(path);
    if (!prim.dataSource || path.IsAbsoluteRootPath() || !isPart(path)) return prim;
    if (prim.primType == HdPrimTypeTokens->material) {
        prim.dataSource = HdOverlayContainerDataSource::New(black(), prim.dataSource);
        return prim;
    }
    if (!isShown(path)) HdPatinaShow(prim, false);
    const HdSampledDataSourceHandle no = HdRetainedTypedSampledDataSource<int>::New(0);
    HdPatinaOverlayPrimvars(prim, {{TfToken("patina:visibility:indirect"), no},
                                   {TfToken("patina:visibility:shadow"), no}});
    return prim;
}

void HdPatinaBackPlateLookSceneIndex::_PrimsDirtied(
    const HdSceneIndexBase&, const HdSceneIndexObserver::DirtiedPrimEntries& entries) {
    HdSceneIndexObserver::DirtiedPrimEntries dirtied = entries;
    for (const auto& entry : entries) {
        const bool camera =
            entry.dirtyLocators.Intersects(HdSceneGlobalsSchema::GetPrimaryCameraPrimLocator());
        const SdfPath& top = entry.primPath; // of the camera, or of all
        if (!camera && !entry.dirtyLocators.Intersects(HdCameraSchema::GetBackPlateLocator()))
            continue;
        for (const SdfPath& path : HdSceneIndexPrimView(_GetInputSceneIndex(), top))
            if (path.GetNameToken() == HdPrimTypeTokens->mesh && isPart(path))
                dirtied.emplace_back(path, HdVisibilitySchema::GetDefaultLocator());
    }
    _SendPrimsDirtied(dirtied);
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif

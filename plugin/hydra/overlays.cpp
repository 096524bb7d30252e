// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/overlays.h"

#include <pxr/imaging/hd/instancerTopologySchema.h>

#include <algorithm>

PXR_NAMESPACE_OPEN_SCOPE

bool HdPatinaIsOfNativeInstances(const SdfPath& path) {
    const SdfPathVector above = path.GetPrefixes();
    return std::any_of(above.begin(), above.end(), [](const SdfPath& prefix) {
        return prefix.GetName() == "UsdNiPropagatedPrototypes"; // UsdImaging's name
    });
}

SdfPathVector HdPatinaScenePaths(const HdSceneIndexBaseRefPtr& scene, const SdfPath& path) {
    constexpr size_t most = 1000;
    static const TfToken prototype("UsdNiPrototype"); // UsdImaging's name
    for (SdfPath root = path; root.GetPathElementCount() > 1; root = root.GetParentPath()) {
        if (root.GetNameToken() != prototype) continue;
        const auto located = HdInstancerTopologySchema::GetFromParent(
                                 scene->GetPrim(root.GetParentPath()).dataSource)
                                 .GetInstanceLocations();
        SdfPathVector found;
        if (!located) return found;
        const SdfPath inner = path.MakeRelativePath(root);
        for (const SdfPath& place : located->GetTypedValue(0.0f)) {
            for (const SdfPath& outer : HdPatinaScenePaths(scene, place))
                found.push_back(path == root ? outer : outer.AppendPath(inner));
            if (found.size() > most) return {};
        }
        return found;
    }
    return {path};
}

void HdPatinaMaskInstances(HdSceneIndexPrim& prim, const SdfPath& path,
                           const std::function<std::optional<bool>(const SdfPath&)>& decided) {
    HdInstancerTopologySchema topology = HdInstancerTopologySchema::GetFromParent(prim.dataSource);
    if (!topology) return;
    const auto masked = topology.GetMask();
    VtBoolArray mask = masked ? masked->GetTypedValue(0.0f) : VtBoolArray();
    const auto located = topology.GetInstanceLocations();
    const VtArray<SdfPath> locations = located ? located->GetTypedValue(0.0f) : VtArray<SdfPath>();
    size_t count = locations.size(); // of native instances; others are instances of one prim
    if (locations.empty() && decided(path)) {
        HdIntArrayVectorSchema indices = topology.GetInstanceIndices();
        for (size_t i = 0; i < indices.GetNumElements(); ++i)
            for (const int index : indices.GetElement(i)->GetTypedValue(0.0f))
                count = std::max(count, size_t(index) + 1);
    }
    mask.resize(std::max(mask.size(), count), true);
    bool same = true;
    for (size_t i = 0; i < count; ++i) {
        const bool drawn = decided(locations.empty() ? path : locations[i]).value_or(mask[i]);
        same &= drawn == mask[i];
        mask[i] = drawn;
    }
    if (same) return;
    prim.dataSource = HdOverlayContainerDataSource::New(
        HdRetainedContainerDataSource::New(
            HdInstancerTopologySchema::GetSchemaToken(),
            HdRetainedContainerDataSource::New(
                HdInstancerTopologySchemaTokens->mask,
                HdRetainedTypedSampledDataSource<VtBoolArray>::New(mask))),
        prim.dataSource);
}

PXR_NAMESPACE_CLOSE_SCOPE

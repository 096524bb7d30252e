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

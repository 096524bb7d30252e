// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/renderPassSceneIndex.h"

#if PATINA_HAS_RENDER_PASSES

#include "plugin/hydra/overlays.h"

#include <pxr/imaging/hd/collectionsSchema.h>
#include <pxr/imaging/hd/instancerTopologySchema.h>
#include <pxr/imaging/hd/lightSchema.h>
#include <pxr/imaging/hd/sceneGlobalsSchema.h>
#include <pxr/imaging/hd/sceneIndexPrimView.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

/// By Collection.
const std::array<TfToken, 4>& names() {
    static const std::array<TfToken, 4> all{TfToken("renderVisibility"), TfToken("prune"),
                                            TfToken("cameraVisibility"), TfToken("matte")};
    return all;
}

/// Whether a prim is a part of native instances, which are drawn or not where they stand.
bool isOfNativeInstances(const SdfPath& path) {
    const SdfPathVector above = path.GetPrefixes();
    return std::any_of(above.begin(), above.end(), [](const SdfPath& prefix) {
        return prefix.GetName() == "UsdNiPropagatedPrototypes"; // UsdImaging's name
    });
}

HdSampledDataSourceHandle number(int value) {
    return HdRetainedTypedSampledDataSource<int>::New(value);
}

} // namespace

HdPatinaRenderPassSceneIndex::HdPatinaRenderPassSceneIndex(const HdSceneIndexBaseRefPtr& input)
    : HdPatinaFilterSceneIndex(input) {
    update();
}

bool HdPatinaRenderPassSceneIndex::has(Collection collection, const SdfPath& path) const {
    const auto& evaluator = _collections[collection].evaluator;
    if (!evaluator) return collection == RenderVisibility || collection == CameraVisibility;
    return evaluator->Match(path);
}

HdSceneIndexPrim HdPatinaRenderPassSceneIndex::GetPrim(const SdfPath& path) const {
    HdSceneIndexPrim prim = _GetInputSceneIndex()->GetPrim(path);
    if (_path.IsEmpty() || !prim.dataSource) return prim;
    if (prim.primType == HdPrimTypeTokens->instancer) {
        mask(path, prim);
    } else if ((HdPrimTypeIsGprim(prim.primType) || HdPrimTypeIsLight(prim.primType)) &&
               !isOfNativeInstances(path)) {
        if (!isDrawn(path)) HdPatinaHide(prim);
        static const TfToken seen("patina:visibility:camera");
        std::vector<std::pair<TfToken, HdSampledDataSourceHandle>> marks;
        if (!has(CameraVisibility, path)) {
            marks.emplace_back(seen, number(0));
            // Lights have parameters; the light of a mesh is seen as the mesh.
            if (HdPrimTypeIsLight(prim.primType) && prim.primType != HdPrimTypeTokens->meshLight)
                prim.dataSource = HdOverlayContainerDataSource::New(
                    HdRetainedContainerDataSource::New(
                        HdLightSchema::GetSchemaToken(),
                        HdRetainedContainerDataSource::New(seen, number(0))),
                    prim.dataSource);
        }
        if (has(Matte, path)) marks.emplace_back(TfToken("patina:matte"), number(1));
        HdPatinaOverlayPrimvars(prim, marks);
    }
    return prim;
}

void HdPatinaRenderPassSceneIndex::mask(const SdfPath& path, HdSceneIndexPrim& prim) const {
    HdInstancerTopologySchema topology = HdInstancerTopologySchema::GetFromParent(prim.dataSource);
    if (!topology) return;
    const auto masked = topology.GetMask();
    VtBoolArray mask = masked ? masked->GetTypedValue(0.0f) : VtBoolArray();
    const auto located = topology.GetInstanceLocations();
    const VtArray<SdfPath> locations = located ? located->GetTypedValue(0.0f) : VtArray<SdfPath>();
    size_t count = locations.size(); // of native instances; others are instances of one prim
    if (locations.empty() && !isOfNativeInstances(path) && !isDrawn(path)) {
        HdIntArrayVectorSchema indices = topology.GetInstanceIndices();
        for (size_t i = 0; i < indices.GetNumElements(); ++i)
            for (const int index : indices.GetElement(i)->GetTypedValue(0.0f))
                count = std::max(count, size_t(index) + 1);
    }
    if (mask.empty()) mask.assign(count, true);
    bool all = true;
    for (size_t i = 0; i < std::min(mask.size(), count); ++i) {
        mask[i] = mask[i] && isDrawn(locations.empty() ? path : locations[i]);
        all &= mask[i];
    }
    if (all) return;
    prim.dataSource = HdOverlayContainerDataSource::New(
        HdRetainedContainerDataSource::New(
            HdInstancerTopologySchema::GetSchemaToken(),
            HdRetainedContainerDataSource::New(
                HdInstancerTopologySchemaTokens->mask,
                HdRetainedTypedSampledDataSource<VtBoolArray>::New(mask))),
        prim.dataSource);
}

bool HdPatinaRenderPassSceneIndex::update() {
    const HdSceneIndexBaseRefPtr& input = _GetInputSceneIndex();
    const auto active = HdSceneGlobalsSchema::GetFromSceneIndex(input).GetActiveRenderPassPrim();
    SdfPath path = active ? active->GetTypedValue(0.0f) : SdfPath();
    Collections now;
    if (!path.IsEmpty()) {
        HdCollectionsSchema all =
            HdCollectionsSchema::GetFromParent(input->GetPrim(path).dataSource);
        for (size_t i = 0; all && i < now.size(); ++i) {
            const auto expression = all.GetCollection(names()[i]).GetMembershipExpression();
            if (!expression) continue;
            now[i].expression = expression->GetTypedValue(0.0f);
            now[i].evaluator.emplace(input, now[i].expression);
        }
    }
    const bool same = path == _path && std::equal(now.begin(), now.end(), _collections.begin(),
                                                  [](const Members& a, const Members& b) {
                                                      return a.expression == b.expression;
                                                  });
    _path = std::move(path);
    _collections = std::move(now);
    return !same;
}

template <class Entries> void HdPatinaRenderPassSceneIndex::updateFrom(const Entries& entries) {
    const bool may = std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
        return entry.primPath.IsAbsoluteRootPath() || entry.primPath == _path; // globals are there
    });
    if (!may || !update()) return;
    static const HdDataSourceLocatorSet locators{
        HdLightSchema::GetDefaultLocator(), HdVisibilitySchema::GetDefaultLocator(),
        HdPrimvarsSchema::GetDefaultLocator(), HdInstancerTopologySchema::GetDefaultLocator()};
    HdSceneIndexObserver::DirtiedPrimEntries dirtied;
    for (const SdfPath& path : HdSceneIndexPrimView(_GetInputSceneIndex()))
        dirtied.emplace_back(path, locators);
    _SendPrimsDirtied(dirtied);
}

void HdPatinaRenderPassSceneIndex::_PrimsAdded(
    const HdSceneIndexBase&, const HdSceneIndexObserver::AddedPrimEntries& entries) {
    _SendPrimsAdded(entries);
    updateFrom(entries);
}

void HdPatinaRenderPassSceneIndex::_PrimsRemoved(
    const HdSceneIndexBase&, const HdSceneIndexObserver::RemovedPrimEntries& entries) {
    _SendPrimsRemoved(entries);
    updateFrom(entries);
}

void HdPatinaRenderPassSceneIndex::_PrimsDirtied(
    const HdSceneIndexBase&, const HdSceneIndexObserver::DirtiedPrimEntries& entries) {
    _SendPrimsDirtied(entries);
    updateFrom(entries);
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif

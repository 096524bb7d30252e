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
        HdPatinaMaskInstances(prim, path, [&](const SdfPath& which) -> std::optional<bool> {
            if (isDrawn(which) || (which == path && HdPatinaIsOfNativeInstances(path))) return {};
            return false;
        });
    } else if (HdPrimTypeIsGprim(prim.primType) || HdPrimTypeIsLight(prim.primType)) {
        // What is in native instances is drawn where one of them says so, and is marked where all
        // do.
        const SdfPathVector paths = HdPatinaScenePaths(_GetInputSceneIndex(), path);
        const auto all = [&](const auto& holds) {
            return !paths.empty() && std::all_of(paths.begin(), paths.end(), holds);
        };
        if (all([&](const SdfPath& one) { return !isDrawn(one); })) HdPatinaShow(prim, false);
        static const TfToken seen("patina:visibility:camera");
        std::vector<std::pair<TfToken, HdSampledDataSourceHandle>> marks;
        if (all([&](const SdfPath& one) { return !has(CameraVisibility, one); })) {
            marks.emplace_back(seen, number(0));
            // Lights have parameters; the light of a mesh is seen as the mesh.
            if (HdPrimTypeIsLight(prim.primType) && prim.primType != HdPrimTypeTokens->meshLight)
                prim.dataSource = HdOverlayContainerDataSource::New(
                    HdRetainedContainerDataSource::New(
                        HdLightSchema::GetSchemaToken(),
                        HdRetainedContainerDataSource::New(seen, number(0))),
                    prim.dataSource);
        }
        if (all([&](const SdfPath& one) { return has(Matte, one); }))
            marks.emplace_back(TfToken("patina:matte"), number(1));
        HdPatinaOverlayPrimvars(prim, marks);
    }
    return prim;
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
    Dirtied dirtied;
    for (const SdfPath& path : HdSceneIndexPrimView(_GetInputSceneIndex()))
        dirtied.emplace_back(path, locators);
    _SendPrimsDirtied(dirtied);
}

void HdPatinaRenderPassSceneIndex::_PrimsAdded(const HdSceneIndexBase&, const Added& entries) {
    _SendPrimsAdded(entries);
    updateFrom(entries);
}

void HdPatinaRenderPassSceneIndex::_PrimsRemoved(const HdSceneIndexBase&, const Removed& entries) {
    _SendPrimsRemoved(entries);
    updateFrom(entries);
}

void HdPatinaRenderPassSceneIndex::_PrimsDirtied(const HdSceneIndexBase&, const Dirtied& entries) {
    _SendPrimsDirtied(entries);
    updateFrom(entries);
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif

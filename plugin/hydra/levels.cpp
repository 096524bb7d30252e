// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/levels.h"

#if PATINA_HAS_LEVELS

#include "base/messages.h"

#include <pxr/imaging/hd/retainedDataSource.h>
#include <pxr/usd/usd/primRange.h>
#include <pxr/usd/usdGeom/imageable.h>
#include <pxr/usd/usdLod/distanceHeuristic.h>
#include <pxr/usd/usdLod/overrideAPI.h>
#include <pxr/usd/usdLod/rootAPI.h>
#include <pxr/usd/usdLod/screenSizeHeuristic.h>
#include <pxr/usdImaging/usdImaging/apiSchemaAdapter.h>
#include <pxr/usdImaging/usdImaging/dataSourceStageGlobals.h>

#include <algorithm>
#include <cmath>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

const TfToken& key() {
    static const TfToken name("patinaLevels");
    return name;
}

const TfToken& overrideKey() {
    static const TfToken name("patinaLevelsOverride");
    return name;
}

void tell(const UsdPrim& root, const patina::Message& message) {
    TF_WARN("%s lod:heuristics: %s", root.GetPath().GetText(), message.text().c_str());
}

void readHeuristic(const UsdPrim& root, UsdTimeCode time, HdPatinaLevels& out) {
    SdfPathVector targets;
    UsdLodRootAPI(root).GetLodHeuristicsRel().GetForwardedTargets(&targets);
    for (const SdfPath& target : targets) {
        const UsdPrim prim = root.GetStage()->GetPrimAtPath(target);
        if (!prim || !prim.IsA<UsdLodHeuristic>()) {
            tell(root, patina::messages::levelUnchosen(target.GetString()));
            continue;
        }
        TfToken domain;
        UsdLodHeuristic(prim).GetLodDomainAttr().Get(&domain);
        if (domain != "imaging") continue;
        if (const UsdLodDistanceHeuristic distance{prim}) {
            out.heuristic.emplace<UsdLodDistanceHeuristicQuery>(
                distance.CreateDistanceHeuristicQuery(time));
            return;
        }
        if (const UsdLodScreenSizeHeuristic size{prim}) {
            out.heuristic.emplace<UsdLodScreenSizeHeuristicQuery>(
                size.CreateScreenSizeHeuristicQuery(time));
            return;
        }
        tell(root, patina::messages::levelTypeUnknown(target.GetString(),
                                                      prim.GetTypeName().GetString()));
    }
}

bool isInvisible(const UsdPrim& prim, UsdTimeCode time) {
    TfToken visibility;
    const UsdGeomImageable imageable(prim);
    return imageable && imageable.GetVisibilityAttr().Get(&visibility, time) &&
           visibility == UsdGeomTokens->invisible;
}

HdPatinaLevelsHandle read(const UsdPrim& root, UsdTimeCode time) {
    auto out = std::make_shared<HdPatinaLevels>();
    out->mode = UsdLodOverrideAPI(root).ComputeLODOverride(&out->overridden, time);
    UsdLodRootAPI(root).GetLodDefaultIndexAttr().Get(&out->fallback, time);
    readHeuristic(root, time, *out);
    for (const UsdPrim& item :
         root.GetFilteredChildren(UsdTraverseInstanceProxies(UsdPrimDefaultPredicate))) {
        out->items.push_back(item.GetName());
        if (!isInvisible(item, time)) continue;
        for (const UsdPrim& prim :
             UsdPrimRange(item, UsdTraverseInstanceProxies(UsdPrimDefaultPredicate)))
            if (isInvisible(prim, time))
                out->invisible.insert(prim.GetPath().MakeRelativePath(root.GetPath()));
    }
    return out;
}

bool mayVary(const UsdPrim& root) {
    for (UsdPrim prim = root; prim; prim = prim.GetParent()) // overrides are inherited
        for (const UsdAttribute& attribute : {UsdLodOverrideAPI(prim).GetLodOverrideModeAttr(),
                                              UsdLodOverrideAPI(prim).GetLodOverrideIndexAttr()})
            if (attribute && attribute.ValueMightBeTimeVarying()) return true;
    if (UsdLodRootAPI(root).GetLodDefaultIndexAttr().ValueMightBeTimeVarying()) return true;
    SdfPathVector targets;
    UsdLodRootAPI(root).GetLodHeuristicsRel().GetForwardedTargets(&targets);
    for (const SdfPath& target : targets)
        if (const UsdPrim prim = root.GetStage()->GetPrimAtPath(target))
            for (const UsdAttribute& attribute : prim.GetAuthoredAttributes())
                if (attribute.ValueMightBeTimeVarying()) return true;
    return false;
}

/// Reads when it is asked: filters of the host keep it while the stage changes.
class LevelsSource final : public HdTypedSampledDataSource<HdPatinaLevelsHandle> {
public:
    HD_DECLARE_DATASOURCE(LevelsSource)

    VtValue GetValue(Time shutterOffset) override { return VtValue(GetTypedValue(shutterOffset)); }
    HdPatinaLevelsHandle GetTypedValue(Time) override { return read(_root, _globals.GetTime()); }
    bool GetContributingSampleTimesForInterval(Time, Time, std::vector<Time>*) override {
        return false;
    }

private:
    LevelsSource(const UsdPrim& root, const UsdImagingDataSourceStageGlobals& globals)
        : _root(root), _globals(globals) {
        if (mayVary(root)) globals.FlagAsTimeVarying(root.GetPath(), HdPatinaLevelsLocator());
    }

    UsdPrim _root;
    const UsdImagingDataSourceStageGlobals& _globals;
};

} // namespace

std::optional<int> HdPatinaLevels::chosen(const GfFrustum& view, const GfMatrix4d& toWorld) const {
    if (mode == UsdLodTokens->noLOD) return -1;
    if (mode == UsdLodTokens->allLOD) return {};
    float index = NAN;
    if (mode == UsdLodTokens->indexedLOD)
        index = overridden;
    else if (const auto* distance = std::get_if<UsdLodDistanceHeuristicQuery>(&heuristic))
        index = distance->ComputeLOD(view.GetPosition(), toWorld);
    else if (const auto* size = std::get_if<UsdLodScreenSizeHeuristicQuery>(&heuristic))
        index = size->ComputeLOD(view, toWorld);
    const float last = float(items.size()) - 1.0f;
    if (!std::isfinite(index)) index = float(fallback);
    return int(std::clamp(std::floor(index + 0.5f), 0.0f, std::max(last, 0.0f)));
}

const HdDataSourceLocator& HdPatinaLevelsLocator() {
    static const HdDataSourceLocator locator(key());
    return locator;
}

const HdDataSourceLocator& HdPatinaLevelsOverrideLocator() {
    static const HdDataSourceLocator locator(overrideKey());
    return locator;
}

HdPatinaLevelsHandle HdPatinaLevelsOf(const HdContainerDataSourceHandle& prim) {
    if (!prim) return nullptr;
    const auto source = HdTypedSampledDataSource<HdPatinaLevelsHandle>::Cast(prim->Get(key()));
    return source ? source->GetTypedValue(0.0f) : nullptr;
}

/// Hands UsdLod's LODRootAPI on, which UsdImaging leaves out.
class HdPatinaLodRootAdapter final : public UsdImagingAPISchemaAdapter {
public:
    HdContainerDataSourceHandle
    GetImagingSubprimData(const UsdPrim& prim, const TfToken& subprim, const TfToken&,
                          const UsdImagingDataSourceStageGlobals& globals) override {
        if (!subprim.IsEmpty()) return nullptr;
        return HdRetainedContainerDataSource::New(key(), LevelsSource::New(prim, globals));
    }
    HdDataSourceLocatorSet InvalidateImagingSubprim(const UsdPrim&, const TfToken& subprim,
                                                    const TfToken&, const TfTokenVector& properties,
                                                    UsdImagingPropertyInvalidationType) override {
        const bool own = std::any_of(properties.begin(), properties.end(), [](const TfToken& name) {
            return TfStringStartsWith(name.GetString(), "lod:");
        });
        return subprim.IsEmpty() && own ? HdPatinaLevelsLocator() : HdDataSourceLocatorSet();
    }
};

/// Tells that an override changed: it counts for the roots below.
class HdPatinaLodOverrideAdapter final : public UsdImagingAPISchemaAdapter {
public:
    HdDataSourceLocatorSet InvalidateImagingSubprim(const UsdPrim&, const TfToken& subprim,
                                                    const TfToken&, const TfTokenVector& properties,
                                                    UsdImagingPropertyInvalidationType) override {
        const bool own = std::any_of(properties.begin(), properties.end(), [](const TfToken& name) {
            return TfStringStartsWith(name.GetString(), "lod:override:");
        });
        return subprim.IsEmpty() && own ? HdPatinaLevelsOverrideLocator()
                                        : HdDataSourceLocatorSet();
    }
};

TF_REGISTRY_FUNCTION(TfType) {
    TfType::Define<HdPatinaLodRootAdapter, TfType::Bases<UsdImagingAPISchemaAdapter>>()
        .SetFactory<UsdImagingAPISchemaAdapterFactory<HdPatinaLodRootAdapter>>();
    TfType::Define<HdPatinaLodOverrideAdapter, TfType::Bases<UsdImagingAPISchemaAdapter>>()
        .SetFactory<UsdImagingAPISchemaAdapterFactory<HdPatinaLodOverrideAdapter>>();
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/imaging/hd/overlayContainerDataSource.h>
#include <pxr/imaging/hd/primvarSchema.h>
#include <pxr/imaging/hd/primvarsSchema.h>
#include <pxr/imaging/hd/retainedDataSource.h>
#include <pxr/imaging/hd/sceneIndex.h>
#include <pxr/imaging/hd/visibilitySchema.h>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

inline HdContainerDataSourceHandle HdPatinaConstantPrimvar(const HdSampledDataSourceHandle& value) {
    return HdPrimvarSchema::Builder()
        .SetPrimvarValue(value)
        .SetInterpolation(
            HdPrimvarSchema::BuildInterpolationDataSource(HdPrimvarSchemaTokens->constant))
        .Build();
}

/// What a data source holds at the frame's time; without one the fallback.
template <class T, class Source> T HdPatinaValueOf(const Source& source, const T& fallback) {
    return source ? T(source->GetTypedValue(0.0f)) : fallback;
}

/// Lays constant primvars over those of a prim.
inline void
HdPatinaOverlayPrimvars(HdSceneIndexPrim& prim,
                        const std::vector<std::pair<TfToken, HdSampledDataSourceHandle>>& values) {
    if (values.empty()) return;
    std::vector<TfToken> names;
    std::vector<HdDataSourceBaseHandle> primvars;
    for (const auto& [name, value] : values) {
        names.push_back(name);
        primvars.push_back(HdPatinaConstantPrimvar(value));
    }
    prim.dataSource = HdOverlayContainerDataSource::New(
        HdRetainedContainerDataSource::New(
            HdPrimvarsSchemaTokens->primvars,
            HdRetainedContainerDataSource::New(names.size(), names.data(), primvars.data())),
        prim.dataSource);
}

inline void HdPatinaShow(HdSceneIndexPrim& prim, bool visible) {
    prim.dataSource = HdOverlayContainerDataSource::New(
        HdRetainedContainerDataSource::New(
            HdVisibilitySchema::GetSchemaToken(),
            HdVisibilitySchema::Builder()
                .SetVisibility(HdRetainedTypedSampledDataSource<bool>::New(visible))
                .Build()),
        prim.dataSource);
}

/// Whether a prim is a part of native instances, which are drawn or not where they stand.
bool HdPatinaIsOfNativeInstances(const SdfPath& path);

/// The paths of a prim in the scene: of a part of native instances one in each of them.
/// @returns nothing where there are more than a thousand
SdfPathVector HdPatinaScenePaths(const HdSceneIndexBaseRefPtr& scene, const SdfPath& path);

/// Shows and hides instances of an instancer.
/// @param decided whether an instance at a path, or all of the instancer at its own, is drawn;
/// nothing: as it is
void HdPatinaMaskInstances(HdSceneIndexPrim& prim, const SdfPath& path,
                           const std::function<std::optional<bool>(const SdfPath&)>& decided);

PXR_NAMESPACE_CLOSE_SCOPE

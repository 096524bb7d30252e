// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/imaging/hd/overlayContainerDataSource.h>
#include <pxr/imaging/hd/primvarSchema.h>
#include <pxr/imaging/hd/primvarsSchema.h>
#include <pxr/imaging/hd/retainedDataSource.h>
#include <pxr/imaging/hd/sceneIndex.h>
#include <pxr/imaging/hd/visibilitySchema.h>

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

inline void HdPatinaHide(HdSceneIndexPrim& prim) {
    prim.dataSource = HdOverlayContainerDataSource::New(
        HdRetainedContainerDataSource::New(
            HdVisibilitySchema::GetSchemaToken(),
            HdVisibilitySchema::Builder()
                .SetVisibility(HdRetainedTypedSampledDataSource<bool>::New(false))
                .Build()),
        prim.dataSource);
}

PXR_NAMESPACE_CLOSE_SCOPE

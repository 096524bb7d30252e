// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/filteringSceneIndex.h>

PXR_NAMESPACE_OPEN_SCOPE

/// A scene index that hands all on as it is. A filter overrides what it changes.
/// @tparam Self the filter
template <class Self> class HdPatinaFilterSceneIndex : public HdSingleInputFilteringSceneIndexBase {
public:
    explicit HdPatinaFilterSceneIndex(const HdSceneIndexBaseRefPtr& input)
        : HdSingleInputFilteringSceneIndexBase(input) {}
    static TfRefPtr<Self> New(const HdSceneIndexBaseRefPtr& input) {
        return TfCreateRefPtr(new Self(input));
    }

    HdSceneIndexPrim GetPrim(const SdfPath& path) const override {
        return _GetInputSceneIndex()->GetPrim(path);
    }
    SdfPathVector GetChildPrimPaths(const SdfPath& path) const override {
        return _GetInputSceneIndex()->GetChildPrimPaths(path);
    }

protected:
    using Added = HdSceneIndexObserver::AddedPrimEntries;
    using Removed = HdSceneIndexObserver::RemovedPrimEntries;
    using Dirtied = HdSceneIndexObserver::DirtiedPrimEntries;

    void _PrimsAdded(const HdSceneIndexBase&, const Added& entries) override {
        _SendPrimsAdded(entries);
    }
    void _PrimsRemoved(const HdSceneIndexBase&, const Removed& entries) override {
        _SendPrimsRemoved(entries);
    }
    void _PrimsDirtied(const HdSceneIndexBase&, const Dirtied& entries) override {
        _SendPrimsDirtied(entries);
    }
};

PXR_NAMESPACE_CLOSE_SCOPE

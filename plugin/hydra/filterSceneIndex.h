// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/filteringSceneIndex.h>

PXR_NAMESPACE_OPEN_SCOPE

/// A scene index that hands all on as it is. A filter overrides what it changes.
class HdPatinaFilterSceneIndex : public HdSingleInputFilteringSceneIndexBase {
public:
    HdSceneIndexPrim GetPrim(const SdfPath& path) const override {
        return _GetInputSceneIndex()->GetPrim(path);
    }
    SdfPathVector GetChildPrimPaths(const SdfPath& path) const override {
        return _GetInputSceneIndex()->GetChildPrimPaths(path);
    }

protected:
    using HdSingleInputFilteringSceneIndexBase::HdSingleInputFilteringSceneIndexBase;

    void _PrimsAdded(const HdSceneIndexBase&,
                     const HdSceneIndexObserver::AddedPrimEntries& entries) override {
        _SendPrimsAdded(entries);
    }
    void _PrimsRemoved(const HdSceneIndexBase&,
                       const HdSceneIndexObserver::RemovedPrimEntries& entries) override {
        _SendPrimsRemoved(entries);
    }
    void _PrimsDirtied(const HdSceneIndexBase&,
                       const HdSceneIndexObserver::DirtiedPrimEntries& entries) override {
        _SendPrimsDirtied(entries);
    }
};

PXR_NAMESPACE_CLOSE_SCOPE

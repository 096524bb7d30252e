// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/filteringSceneIndex.h>

#if PATINA_HAS_LIGHT_LINKING

PXR_NAMESPACE_OPEN_SCOPE

TF_DECLARE_REF_PTRS(HdPatinaRelinkedLightSceneIndex);

/// Lets lights of which links change go and come again. HdsiLightLinkingSceneIndex, which has to
/// follow, reads freed memory when it is told instead that a collection is dirty, unless another
/// light has an equal one (seen in OpenUSD 24.11, by AddressSanitizer).
class HdPatinaRelinkedLightSceneIndex final : public HdSingleInputFilteringSceneIndexBase {
public:
    static HdPatinaRelinkedLightSceneIndexRefPtr New(const HdSceneIndexBaseRefPtr& input) {
        return TfCreateRefPtr(new HdPatinaRelinkedLightSceneIndex(input));
    }

    HdSceneIndexPrim GetPrim(const SdfPath& path) const override;
    SdfPathVector GetChildPrimPaths(const SdfPath& path) const override;

protected:
    void _PrimsAdded(const HdSceneIndexBase& sender,
                     const HdSceneIndexObserver::AddedPrimEntries& entries) override;
    void _PrimsRemoved(const HdSceneIndexBase& sender,
                       const HdSceneIndexObserver::RemovedPrimEntries& entries) override;
    void _PrimsDirtied(const HdSceneIndexBase& sender,
                       const HdSceneIndexObserver::DirtiedPrimEntries& entries) override;

private:
    explicit HdPatinaRelinkedLightSceneIndex(const HdSceneIndexBaseRefPtr& input)
        : HdSingleInputFilteringSceneIndexBase(input) {}
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif

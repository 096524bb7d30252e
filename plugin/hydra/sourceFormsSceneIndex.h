// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/hydra/filterSceneIndex.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_DECLARE_REF_PTRS(HdPatinaSourceFormsSceneIndex);

/// Before scene indices make meshes and lines of NURBS, Hermite curves and tetrahedra, hands their
/// attributes on as constant primvars, from which the delegate makes what the stage says
/// (hydra/sourceForms.h). The same for planes, of whose sizes Hydra's adapter tells nothing.
class HdPatinaSourceFormsSceneIndex final : public HdPatinaFilterSceneIndex {
public:
    static HdPatinaSourceFormsSceneIndexRefPtr New(const HdSceneIndexBaseRefPtr& input) {
        return TfCreateRefPtr(new HdPatinaSourceFormsSceneIndex(input));
    }

    HdSceneIndexPrim GetPrim(const SdfPath& path) const override;

protected:
    void _PrimsAdded(const HdSceneIndexBase& sender,
                     const HdSceneIndexObserver::AddedPrimEntries& entries) override;
    void _PrimsDirtied(const HdSceneIndexBase& sender,
                       const HdSceneIndexObserver::DirtiedPrimEntries& entries) override;

private:
    explicit HdPatinaSourceFormsSceneIndex(const HdSceneIndexBaseRefPtr& input)
        : HdPatinaFilterSceneIndex(input) {}
};

PXR_NAMESPACE_CLOSE_SCOPE

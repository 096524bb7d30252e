// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/hydra/filterSceneIndex.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Before scene indices make meshes and lines of NURBS, Hermite curves and tetrahedra, hands their
/// attributes on as constant primvars, from which the delegate makes what the stage says
/// (hydra/sourceForms.h). The same for planes, of whose sizes Hydra's adapter tells nothing.
class HdPatinaSourceFormsSceneIndex final
    : public HdPatinaFilterSceneIndex<HdPatinaSourceFormsSceneIndex> {
public:
    using HdPatinaFilterSceneIndex::HdPatinaFilterSceneIndex;
    HdSceneIndexPrim GetPrim(const SdfPath& path) const override;

protected:
    void _PrimsAdded(const HdSceneIndexBase& sender, const Added& entries) override;
    void _PrimsDirtied(const HdSceneIndexBase& sender, const Dirtied& entries) override;
};

PXR_NAMESPACE_CLOSE_SCOPE

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/hydra/filterSceneIndex.h"

#if PATINA_HAS_BACK_PLATES

PXR_NAMESPACE_OPEN_SCOPE

/// HdsiBackPlateSceneIndex, which comes before, makes a mesh and a material of each back plate of
/// each camera. This one hides those that the image's camera does not show (`plateVisibility`), and
/// makes the others pictures: cameras alone see them, and they reflect nothing.
class HdPatinaBackPlateLookSceneIndex final
    : public HdPatinaFilterSceneIndex<HdPatinaBackPlateLookSceneIndex> {
public:
    using HdPatinaFilterSceneIndex::HdPatinaFilterSceneIndex;
    HdSceneIndexPrim GetPrim(const SdfPath& path) const override;

protected:
    void _PrimsDirtied(const HdSceneIndexBase& sender, const Dirtied& entries) override;

private:
    /// Whether a path is of a mesh or a material of a back plate.
    bool isPart(const SdfPath& path) const;
    bool isShown(const SdfPath& mesh) const;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif

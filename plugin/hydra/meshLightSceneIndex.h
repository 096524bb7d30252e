// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/hydra/filterSceneIndex.h"

#include <set>

PXR_NAMESPACE_OPEN_SCOPE

/// Gives every mesh that is a light (UsdLuxMeshLightAPI) a child prim of type meshLight, which
/// render delegates are told about as of any other light.
class HdPatinaMeshLightSceneIndex final
    : public HdPatinaFilterSceneIndex<HdPatinaMeshLightSceneIndex> {
public:
    explicit HdPatinaMeshLightSceneIndex(const HdSceneIndexBaseRefPtr& input);
    HdSceneIndexPrim GetPrim(const SdfPath& path) const override;
    SdfPathVector GetChildPrimPaths(const SdfPath& path) const override;

protected:
    void _PrimsAdded(const HdSceneIndexBase& sender, const Added& entries) override;
    void _PrimsRemoved(const HdSceneIndexBase& sender, const Removed& entries) override;
    void _PrimsDirtied(const HdSceneIndexBase& sender, const Dirtied& entries) override;

private:
    void populate(const SdfPath& path);
    void addLight(const SdfPath& mesh);
    /// Warns once of a child of the stage's own that the light of its mesh stands in for.
    void warnOfHidden(const SdfPath& child);
    bool isOfStage(const SdfPath& child) const;

    std::set<SdfPath> _lights; ///< meshes that observers know to have a light
    std::set<SdfPath> _hidden; ///< children that were warned of
};

PXR_NAMESPACE_CLOSE_SCOPE

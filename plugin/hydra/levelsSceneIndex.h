// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/hydra/filterSceneIndex.h"
#include "plugin/hydra/levels.h"

#if PATINA_HAS_LEVELS

#include <map>

PXR_NAMESPACE_OPEN_SCOPE

/// Draws of each root of levels of detail (UsdLod, OpenUSD 26.08) what its override, its heuristic
/// or its default index choose for the primary camera. All instances of a prototype show the level
/// of the one that is nearest to the camera.
class HdPatinaLevelsSceneIndex final : public HdPatinaFilterSceneIndex<HdPatinaLevelsSceneIndex> {
public:
    explicit HdPatinaLevelsSceneIndex(const HdSceneIndexBaseRefPtr& input);
    HdSceneIndexPrim GetPrim(const SdfPath& path) const override;

protected:
    void _PrimsAdded(const HdSceneIndexBase& sender, const Added& entries) override;
    void _PrimsRemoved(const HdSceneIndexBase& sender, const Removed& entries) override;
    void _PrimsDirtied(const HdSceneIndexBase& sender, const Dirtied& entries) override;

private:
    struct Root {
        HdPatinaLevelsHandle levels;
        std::optional<int> item; ///< as HdPatinaLevels::chosen()
    };

    /// @returns whether the levels above say that a prim is drawn or not; nothing: it is as it is
    std::optional<bool> decided(const SdfPath& path) const;
    Root read(const SdfPath& path) const;
    struct Place {
        GfMatrix4d matrix; ///< to the world
        SdfPath instance;  ///< path of a native instance
    };
    /// @returns where that instance of a prim is which is nearest to the camera
    Place nearestPlace(const SdfPath& path, int depth) const;
    void readView();
    /// Chooses anew, and tells what is below of roots that show another level.
    void update(bool all, const SdfPathVector& tops);

    std::map<SdfPath, Root> _roots;
    SdfPath _camera;
    GfFrustum _view;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif

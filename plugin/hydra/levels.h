// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#if PATINA_HAS_LEVELS

#include <pxr/base/gf/frustum.h>
#include <pxr/imaging/hd/dataSource.h>
#include <pxr/usd/sdf/path.h>
#include <pxr/usd/usdLod/distanceHeuristicQuery.h>
#include <pxr/usd/usdLod/screenSizeHeuristicQuery.h>

#include <memory>
#include <optional>
#include <set>
#include <variant>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

/// What a prim with UsdLod's LODRootAPI says of its levels.
struct HdPatinaLevels {
    TfTokenVector items;
    TfToken mode; ///< of the override
    float overridden = 0.0f;
    int fallback = 0;
    /// The first one for imaging.
    std::variant<std::monostate, UsdLodDistanceHeuristicQuery, UsdLodScreenSizeHeuristicQuery>
        heuristic;
    /// Items that are authored invisible, for renderers that know no levels, and what is invisible
    /// in them of its own; relative to the root.
    std::set<SdfPath> invisible;

    /// @param toWorld of the root
    /// @returns an index of items, -1: none is drawn; nothing: all are
    std::optional<int> chosen(const GfFrustum& view, const GfMatrix4d& toWorld) const;
};
using HdPatinaLevelsHandle = std::shared_ptr<const HdPatinaLevels>;

const HdDataSourceLocator& HdPatinaLevelsLocator();
/// Where prims say that they override the levels below.
const HdDataSourceLocator& HdPatinaLevelsOverrideLocator();
/// @returns null of prims that are no root of levels
HdPatinaLevelsHandle HdPatinaLevelsOf(const HdContainerDataSourceHandle& prim);

PXR_NAMESPACE_CLOSE_SCOPE

#endif

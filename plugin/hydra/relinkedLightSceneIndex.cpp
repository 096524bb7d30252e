// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/relinkedLightSceneIndex.h"

#if PATINA_HAS_LIGHT_LINKING

#include <pxr/imaging/hd/collectionsSchema.h>
#include <pxr/imaging/hd/tokens.h>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

bool hasLinks(const TfToken& primType) {
    return HdPrimTypeIsLight(primType) || primType == HdPrimTypeTokens->lightFilter;
}

} // namespace

void HdPatinaRelinkedLightSceneIndex::_PrimsDirtied(const HdSceneIndexBase&,
                                                    const Dirtied& entries) {
    // A prim that loses its type keeps its children, while removal would take them along.
    Added untyped, typed;
    for (const auto& entry : entries) {
        if (!entry.dirtyLocators.Intersects(HdCollectionsSchema::GetDefaultLocator())) continue;
        const TfToken type = _GetInputSceneIndex()->GetPrim(entry.primPath).primType;
        if (!hasLinks(type)) continue;
        untyped.emplace_back(entry.primPath, TfToken());
        typed.emplace_back(entry.primPath, type);
    }
    if (!typed.empty()) {
        _SendPrimsAdded(untyped);
        _SendPrimsAdded(typed);
    }
    _SendPrimsDirtied(entries);
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif

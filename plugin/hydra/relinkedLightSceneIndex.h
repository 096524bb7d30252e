// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/hydra/filterSceneIndex.h"

#if PATINA_HAS_LIGHT_LINKING

PXR_NAMESPACE_OPEN_SCOPE

/// Lets lights of which links change go and come again. HdsiLightLinkingSceneIndex, which has to
/// follow, reads freed memory when it is told instead that a collection is dirty, unless another
/// light has an equal one (seen in OpenUSD 24.11, by AddressSanitizer).
class HdPatinaRelinkedLightSceneIndex final
    : public HdPatinaFilterSceneIndex<HdPatinaRelinkedLightSceneIndex> {
public:
    using HdPatinaFilterSceneIndex::HdPatinaFilterSceneIndex;

protected:
    void _PrimsDirtied(const HdSceneIndexBase& sender, const Dirtied& entries) override;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif

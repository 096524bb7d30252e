// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"

#include <pxr/imaging/hd/material.h>

namespace patina {

/// A material's network as authored: surface, displacement and volume.
class HdPatinaMaterial final : public HdMaterial {
public:
    explicit HdPatinaMaterial(const SdfPath& id) : HdMaterial(id) {}

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
              HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;
    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
};

} // namespace patina

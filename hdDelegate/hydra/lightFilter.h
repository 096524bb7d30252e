// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/light.h"

#include <pxr/imaging/hd/changeTracker.h>
#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/sprim.h>

namespace patina {

/// A light filter holds nothing: the lights that name it read it, and are read again when it
/// changes.
class HdPatinaLightFilter final : public HdSprim {
public:
    explicit HdPatinaLightFilter(const SdfPath& id) : HdSprim(id) {}

    void Sync(HdSceneDelegate*, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) override {
        if (*dirtyBits != HdChangeTracker::Clean) tellReaders(renderParam);
        *dirtyBits = HdChangeTracker::Clean;
    }
    void Finalize(HdRenderParam* renderParam) override { tellReaders(renderParam); }
    HdDirtyBits GetInitialDirtyBitsMask() const override {
        return HdChangeTracker::AllSceneDirtyBits;
    }

private:
    void tellReaders(HdRenderParam* renderParam) {
        static_cast<HdPatinaRenderParam*>(renderParam)->setChanged(GetId());
    }
};

/// The filters that a light names. One of unknown type is left out with a warning.
std::vector<LightFilter> readLightFilters(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                          const SdfPath& light);

} // namespace patina

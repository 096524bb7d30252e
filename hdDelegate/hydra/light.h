// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/light.h"

#include <pxr/imaging/hd/light.h>

#include <memory>

namespace patina {

/// Every UsdLux light: shape, colour, shaping, shadow, textures, linking, portals where the host
/// has scene indices. The camera light that hosts add shines so that a white matte surface that
/// faces it looks white.
class HdPatinaLight final : public HdLight {
public:
    HdPatinaLight(const TfToken& type, const SdfPath& id) : HdLight(id), _type(type) {}

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
              HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;
    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }

    /// Samples the transform again where the shutter has become longer since. Host's thread, while
    /// nothing syncs.
    void updateTransform(HdPatinaRenderParam& param);
    /// Reads its colours and all other values again. Host's thread, while nothing syncs.
    void updateParams(HdPatinaRenderParam& param);
    /// Reads its filters again, as one of them changed. Host's thread, while nothing syncs.
    void updateFilters(HdPatinaRenderParam& param);

private:
    TfToken _type;
    std::shared_ptr<const Light> _light;
    HdSceneDelegate* _delegate = nullptr; ///< of the last sync; render indices tell none of sprims
    GfVec2f _shutter{0.0f};               ///< over which the transform was sampled
};

} // namespace patina

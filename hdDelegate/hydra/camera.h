// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"

#include <pxr/imaging/hd/camera.h>

#include <memory>

namespace patina {

/// A camera that render passes find under its path in the scene. HdCamera's own lens distortion and
/// split diopters are not modelled; cameraInputs.def has what is.
class HdPatinaCamera final : public HdCamera {
public:
    explicit HdPatinaCamera(const SdfPath& id) : HdCamera(id) {}

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
              HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;
    /// Samples the transform again where the shutter has become longer since. Host's thread, while
    /// nothing syncs.
    void updateTransform(HdPatinaRenderParam& param);

private:
    std::shared_ptr<const Camera> _camera;
    HdSceneDelegate* _delegate = nullptr; ///< of the last sync
    GfVec2f _shutter{0.0f};               ///< over which the transform was sampled
};

} // namespace patina

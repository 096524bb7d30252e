// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/hydra/instances.h"

#include <pxr/base/gf/vec2f.h>
#include <pxr/imaging/hd/instancer.h>

namespace patina {

/// Point instancers and native instances, nested. Rotations of every type that scene delegates have
/// used are understood: quath, quatf, quatd, and vec4 (real part first).
class HdPatinaInstancer final : public HdInstancer {
public:
    HdPatinaInstancer(HdSceneDelegate* delegate, const SdfPath& id);

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
              HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;

    /// Tells the scene again which group of the parent this instancer belongs to: hosts mark only
    /// rprims when the indices of the instancers that hold them change. Any thread.
    void place(HdPatinaRenderParam& param);

    /// Reads the light links of the instances again.
    void updateCategories(HdPatinaRenderParam& param);
    /// Samples the instances again where the shutter has become longer since. Host's thread, while
    /// nothing syncs.
    void updateTransforms(HdPatinaRenderParam& param);
    /// Reads the values of the instances again. Host's thread, while nothing syncs.
    void updateColors(HdPatinaRenderParam& param);

private:
    void readInstances(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                       HdPatinaInstanceData& data);
    void readPrimvars(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                      HdPatinaInstanceData& data) const;

    std::mutex _mutex;
    std::shared_ptr<const HdPatinaInstanceData> _data, _placed;
    std::string _group;
    GfVec2f _shutter{0.0f}; ///< over which the instances were sampled
};

} // namespace patina

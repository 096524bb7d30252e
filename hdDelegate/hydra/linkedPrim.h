// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// An rprim that can be read again outside of its own sync: hosts do not always mark the prims that
/// a changed collection takes in or leaves out, and a delegate must not mark prims itself where the
/// host has scene indices alone.
class HdPatinaLinkedPrim {
public:
    virtual ~HdPatinaLinkedPrim() = default;
    /// Host's thread, while no rprim syncs.
    virtual void updateCategories(HdSceneDelegate& delegate, HdPatinaRenderParam& param) = 0;
    /// Hydra syncs no prim whose render tag is not drawn, so prims that leave are to be asked.
    virtual void updateRenderTag(HdSceneDelegate& delegate, HdPatinaRenderParam& param) = 0;
    /// As a sync with these bits. Any thread, one for each prim.
    virtual void updateBits(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                            HdDirtyBits bits) = 0;
    /// Samples it again where the shutter has become longer since. Any thread, one for each prim.
    virtual void updateSamples(HdSceneDelegate& delegate, HdPatinaRenderParam& param) = 0;
};

} // namespace patina

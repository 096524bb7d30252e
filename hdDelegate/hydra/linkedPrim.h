// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// An rprim of which links and render tag can be read again outside of its own sync: hosts do not
/// always mark the prims that a changed collection takes in or leaves out.
class HdPatinaLinkedPrim {
public:
    virtual ~HdPatinaLinkedPrim() = default;
    /// Host's thread, while no rprim syncs.
    virtual void updateCategories(HdSceneDelegate& delegate, HdPatinaRenderParam& param) = 0;
    /// Hydra syncs no prim whose render tag is not drawn, so prims that leave are to be asked.
    virtual void updateRenderTag(HdSceneDelegate& delegate, HdPatinaRenderParam& param) = 0;
};

} // namespace patina

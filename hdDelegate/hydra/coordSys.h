// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/geometry.h"

#include <pxr/imaging/hd/coordSys.h>
#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// A coordinate system: prims that it is bound to read it, and are read again when it changes.
class HdPatinaCoordSys final : public HdCoordSys {
public:
    using HdCoordSys::HdCoordSys;

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
              HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;
};

/// Gives a prim the matrices of the coordinate systems that are bound to it, as spacePrimvar().
void readCoordSystems(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                      Geometry& prim);

} // namespace patina

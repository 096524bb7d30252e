// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/screenMotion.h"
#include "hdDelegate/embree/surface.h"

namespace patina {

/// What was hit as a place of its prim, which goes where the prim goes.
class HitPlace {
public:
    /// @param frame of the camera whose ray has met it
    HitPlace(const Hit& hit, const CameraFrame& frame) : _hit(hit), _frame(frame) {}

    /// In the prim's own space, where it is when the shutter opens. Of curves and points that is
    /// their middle.
    dvec3 inPrim() const;
    /// In the world at a moment. Points of prims that deform are followed where the scene was built
    /// for that.
    dvec3 inWorld(ScreenMotion::Moment moment) const;

private:
    dvec3 inPrimAt(ScreenMotion::Moment moment) const;

    const Hit& _hit;
    const CameraFrame& _frame;
};

} // namespace patina

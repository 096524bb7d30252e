// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/compat.h"
#include "hdDelegate/embree/surface.h"

namespace patina {

/// A surface as Embree takes it, which reads the surface's own buffers: not committed yet.
/// @returns null where there is nothing to be met
RTCGeometry makeGeometry(RTCDevice device, const Surface& surface);

} // namespace patina

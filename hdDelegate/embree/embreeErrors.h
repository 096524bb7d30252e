// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/compat.h"

#include <new>

namespace patina {

/// Embree throws nothing, and building what it had no memory for ends the process.
/// @throws std::bad_alloc where a call of this thread ran out of memory since the error was last
/// asked for
inline void throwIfOutOfMemory(RTCDevice device) {
    if (rtcGetDeviceError(device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
}

} // namespace patina

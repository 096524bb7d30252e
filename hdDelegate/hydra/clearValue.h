// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/base/vt/value.h>

namespace patina {

/// The host's value for pixels where nothing was hit.
struct ClearValue {
    float values[4] = {0.0f, 0.0f, 0.0f, 0.0f};
    bool isInteger = false; ///< the first value holds the bits of an int32
    bool empty = true;      ///< the host gave none
};

/// Reads clear values of every type that hosts send: int, unsigned, float, double, and vectors of
/// two to four ints, floats, doubles or halfs. Others count as none.
ClearValue clearValueOf(const VtValue& value);

} // namespace patina

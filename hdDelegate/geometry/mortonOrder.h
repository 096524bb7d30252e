// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <cstdint>
#include <vector>

namespace patina {

/// An order of points in which neighbours stay near each other (Morton 1966). Those that it does
/// not tell apart keep theirs.
std::vector<uint32_t> mortonOrder(const std::vector<vec3>& points);

} // namespace patina

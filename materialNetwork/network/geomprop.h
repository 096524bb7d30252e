// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/network/network.h"

#include <string>

namespace patina {

/// The node that stands for a geometric property which inputs may default to: "Nworld", "Tworld",
/// "Bworld", "Pworld", "Vworld", the same of the object, and "UV0". Its path is the name in angle
/// brackets. @returns a node without id for any other name
NetworkNode geompropNode(const std::string& name);

} // namespace patina

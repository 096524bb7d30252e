// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Why a node of MaterialX's library is not drawn (notDrawn.inc).
/// @param id of its definition, or its category
/// @returns null for nodes that are drawn, or that nobody knows
const char* whyNotDrawn(const std::string& id);

} // namespace patina

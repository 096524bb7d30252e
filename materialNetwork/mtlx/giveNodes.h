// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/network/network.h"

#include <cstddef>
#include <vector>

namespace patina {

/// Gives each material the nodes that its terminals reach, in the order of the document.
/// @returns how many materials got none, since all would have more than five times Limit::nodes
size_t giveNodes(const std::vector<NetworkNode>& nodes, std::vector<Network>& materials);

} // namespace patina

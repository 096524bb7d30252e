// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/nodes/models.h"

#include <functional>

namespace patina {

/// A network that grows beyond this is given up.
constexpr size_t maxExpandedNodes = 200000;

using ModelLookup = std::function<const ShadingModel*(const std::string& id)>;

/// Replaces every node that is a shading model by the model's graph, until only primitive nodes are
/// left. Nodes that no terminal reaches are dropped. A network that comes to more than 200,000
/// nodes on the way is given up, with a warning: the result has no terminals. An input of the model
/// that is connected becomes a `dot` node named "node.input", which carries the type of the input
/// and its default.
Network expand(const Network& network, const ModelLookup& models, Diagnostics& diagnostics);

/// expand() with the models of the library.
Network expand(const Network& network, Diagnostics& diagnostics);

} // namespace patina

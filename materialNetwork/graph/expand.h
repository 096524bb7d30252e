// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/nodes/models.h"

#include <functional>

namespace patina {

using ModelLookup = std::function<const ShadingModel*(const std::string& id)>;

/// Replaces every node that is a shading model by the model's graph, until only primitive nodes are
/// left. Nodes that no terminal reaches are dropped. A network that comes to more nodes than
/// Limit::nodes on the way is given up, with a warning: the result has no terminals. A text that
/// is longer than Limit::textLength is left out, with a warning. An input of the model that is
/// connected becomes a `dot` node named "node.input", which carries the type of the input and its
/// default.
Network expand(const Network& network, const ModelLookup& models, Diagnostics& diagnostics);

/// expand() with the models of the library.
Network expand(const Network& network, Diagnostics& diagnostics);

} // namespace patina

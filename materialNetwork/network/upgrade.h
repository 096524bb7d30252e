// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"
#include "materialNetwork/network/network.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace patina {

/// Rewrites nodes of MaterialX 1.38 that 1.39 has changed: swizzle, atan2's inputs, normalmap's
/// `space`, a thin_film_bsdf as the top of a layer, thin_surface. They are known by their form.
/// @param nodes of a material, or of a model's graph
/// @param ends what leads out of them: terminals, or outputs
/// @param before139 says of a node's path whether it was authored against 1.38, where what has the
///     form of 1.39 means something else: `which` of switch, normalmap without a bitangent
void upgradeNodes(std::vector<NetworkNode>& nodes, std::map<std::string, Connection>& ends,
                  const std::function<bool(const std::string& path)>& before139,
                  Diagnostics& diagnostics);

} // namespace patina

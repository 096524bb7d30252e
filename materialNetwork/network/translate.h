// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"
#include "materialNetwork/network/network.h"

#include <string>
#include <vector>

namespace patina {

/// Shading models that translateMaterial() knows: categories such as "gltf_pbr".
std::vector<std::string> translatableModels();

/// Translates a material into another shading model. Translations are data: a model whose category
/// is "A_to_B" has the inputs of A, and an output "x_out" for each input x of B. If there is none
/// from A to B, the translation goes through standard_surface.
/// @param target category of the wanted model, one of translatableModels()
/// @returns a network whose surface is a node of that model, fed by nodes that translate; other
///     terminals are kept. If the surface is of that model already, the network itself. If it is no
///     shading model that can be translated, a network without terminals, after a warning
Network translateMaterial(const Network& network, const std::string& target,
                          Diagnostics& diagnostics);

/// Rewrites a network that was authored against MaterialX 1.38 as 1.39 has it, see upgradeNodes().
void upgradeNetwork(Network& network, Diagnostics& diagnostics);

} // namespace patina

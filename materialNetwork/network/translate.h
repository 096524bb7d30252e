// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/diagnostics.h"
#include "materialNetwork/network/network.h"

#include <string>
#include <vector>

namespace patina {

/// Shading models that translateMaterial() knows: categories such as "gltf_pbr".
std::vector<std::string> translatableModels();

/// Says a material in the words of another shading model. Translations are data: a model whose
/// category is "A_to_B" has the inputs of A and an output "x_out" for each input x of B. Where
/// there is none from A to B, one over standard_surface is taken.
/// @param target category of the model wanted, one of translatableModels()
/// @returns a network whose surface is a node of that model, fed by nodes that translate; other
/// terminals are kept. The network itself where it already is of that model. Without terminals,
/// after a warning, where the surface is no shading model that can be translated.
Network translateMaterial(const Network& network, const std::string& target,
                          Diagnostics& diagnostics);

} // namespace patina

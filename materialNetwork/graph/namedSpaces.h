// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/network/network.h"

namespace patina {

/// Nodes that name a space which is none of MaterialX's own (object, model, world) become the
/// arithmetic of its matrix, which prims have as spacePrimvar() where a coordinate system of that
/// name is bound to them. Where none is, the space is the world.
/// @param network of primitive nodes
void resolveNamedSpaces(Network& network);

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/network/network.h"

namespace patina {

/// A UsdShadeMaterial: its network as authored.
struct MaterialPrim {
    std::string path;
    Network network;
};

} // namespace patina

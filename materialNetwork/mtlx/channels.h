// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"

#include <pugixml.hpp>

#include <string>

namespace patina {

/// Rewrites the `channels` of inputs and outputs, as MaterialX up to 1.38 has them: they read a
/// swizzle of what they are connected to.
/// @param path of the document, for messages
void channelsToSwizzles(pugi::xml_node root, const std::string& path, Diagnostics& diagnostics);

} // namespace patina

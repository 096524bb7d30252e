// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"

#include <pugixml.hpp>

#include <string>

namespace patina {

/// Rewrites elements of MaterialX 1.38 that 1.39 has changed: `swizzle` nodes and `channels`,
/// inputs of atan2, normalmap's `space`, a thin_film_bsdf as the top of a layer, thin_surface.
/// Elements are recognised by their form, whatever version the document has.
/// @param path of the document, for messages
void upgradeDocument(pugi::xml_node root, const std::string& path, Diagnostics& diagnostics);

} // namespace patina

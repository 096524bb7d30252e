// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/network/network.h"

#include <string>

namespace patina {

/// The node that stands for a geometric property which inputs may default to.
/// @param name "Nworld", "Tworld", "Bworld", "Pworld", "Vworld", the same of the object, and "UV0";
///     or a property that a document defines, as customGeomprop() writes it
/// @returns a node whose path is the name in angle brackets; without id for any other name
NetworkNode geompropNode(const std::string& name);

/// The name for geompropNode() of a property that a document defines (geompropdef).
/// @param geomprop the category of a geometric node, as "texcoord"; empty for a primvar of that
/// name
std::string customGeomprop(const std::string& name, const std::string& type,
                           const std::string& geomprop, const std::string& space,
                           const std::string& index);

} // namespace patina

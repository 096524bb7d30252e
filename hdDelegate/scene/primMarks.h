// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "base/diagnostics.h"

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace patina {

/// The value of a primvar of primMarks.def.
using MarkValue = std::variant<double, std::string>;
/// By name, without "primvars:".
using Marks = std::map<std::string, MarkValue>;

/// Names of all primvars that are marks, in the order of their strength.
std::vector<std::string> markNames();
bool isMark(const std::string& name);

/// Sets what marks say; a property without a mark stays. A value that means nothing is told, and
/// counts as not there.
/// @param path of the prim, for messages
void applyMarks(const Marks& marks, Marked& prim, const std::string& path,
                Diagnostics& diagnostics);

} // namespace patina

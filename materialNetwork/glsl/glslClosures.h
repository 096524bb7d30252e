#pragma once

#include "materialNetwork/cpu/programCode.h"

#include <functional>
#include <string>
#include <vector>

namespace patina {

/// Text of a register, a vec4.
using GlslRegister = std::function<std::string(int)>;

/// Statements that compute emission closures, as linearClosure().
/// @param prefix of the variables that they declare
/// @param result is set to what holds the value of the whole
std::string glslLinearClosure(const std::vector<ClosureOp>& ops, const std::string& prefix,
                              const GlslRegister& reg, std::string& result);

/// Statements that add volume closures to the Medium `m`, as buildMedium().
std::string glslVdf(const std::vector<ClosureOp>& ops, const GlslRegister& reg);

} // namespace patina

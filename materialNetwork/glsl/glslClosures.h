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
/// @param profile name of a function with the profile of a MeasuredEdf; empty: it emits evenly
/// @param result is set to what holds the value of the whole
std::string glslLinearClosure(const std::vector<ClosureOp>& ops, const std::string& prefix,
                              const GlslRegister& reg,
                              const std::function<std::string(const ClosureOp&)>& profile,
                              std::string& result);

/// A profile as glslProfile() reads it: over even steps of the angle to the axis, 0 to a quarter
/// turn, for every step of the turn about it, the last of which is the first again; four values to
/// a vector.
struct GlslProfileTable {
    int angles = 0, turns = 0;
    std::vector<glm::vec4> values;
    explicit GlslProfileTable(const EmissionProfile& profile);
};
/// A function of the direction and the axis, as measured() of bsdfBuilder.cpp.
/// @param first place of the table in the parameters
std::string glslProfile(const std::string& name, const GlslProfileTable& table, size_t first);

/// Statements that add volume closures to the Medium `m`, as buildMedium().
std::string glslVdf(const std::vector<ClosureOp>& ops, const GlslRegister& reg);

} // namespace patina

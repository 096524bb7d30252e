// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/glsl/closureText.h"

#include <functional>
#include <string>
#include <vector>

namespace patina {

/// Statements that compute emission closures along `wo`: emissionOf() in text.
/// @param prefix of the variables that they declare
/// @param profile name of a function with the profile of a MeasuredEdf; empty: it emits evenly
/// @param result is set to what holds the value of the whole
std::string glslEmission(const std::vector<ClosureOp>& ops, const std::string& prefix,
                         const GlslRegister& registers,
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
/// A function of the direction and the axis, with the profile's factor.
/// @param first place of the table in the parameters
std::string glslProfile(const std::string& name, const GlslProfileTable& table, size_t first);

/// Statements that add volume closures to the Medium `m`: addMedia() in text.
std::string glslMedia(const std::vector<ClosureOp>& ops, const GlslRegister& registers);

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/materialIr.h"

#include <functional>
#include <string>

namespace patina {

/// GLSL type of a lobe, "ConductorLobe".
std::string glslLobeType(LobeKind kind);

/// GLSL expression that sets a lobe up, as setupLobe() does.
/// @param registers text of a register, a vec4
std::string glslLobeSetup(const LobeTemplate& lobe,
                          const std::function<std::string(Register)>& registers);

/// Lines that tell a lobe its methods, after its set-up; none for the defaults.
/// @param lobe the variable
std::string glslLobeMethods(const LobeTemplate& t, const std::string& lobe);

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "materialNetwork/nodes/nodeDef.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>

namespace patina {

/// Whether an output of one type can feed an input of another.
enum class Coercion {
    None,      ///< types do not fit
    Free,      ///< the register can be read as it is
    AppendOne, ///< three components to four, the fourth is 1
    Append     ///< two components to three, the third is 0
};
Coercion coercion(ValueType from, ValueType to);

/// Brings an authored value to the type of an input: components (1 to all, 3 to 4 by appending 1, 4
/// to 3), names of an enumeration to numbers, colours to linear Rec.709.
/// @param problem says what is wrong when false is returned; with true it is empty, or says that
/// the colour space is not known and the value is used as it is
bool coerceValue(const Value& from, const InputDef& to, Value& out,
                 std::optional<Message>& problem);

/// Registers that a value of this type takes: one per row of a matrix, else one.
int registerCount(ValueType type);

/// Writes the numbers of a value as registers, row by row; one number fills its register.
void valueRows(const Value& value, glm::vec4* rows);

bool sameValue(const Value& a, const Value& b);

/// @returns "0.5", "1, 0, 0" or quoted text
std::string valueText(const Value& value);

} // namespace patina

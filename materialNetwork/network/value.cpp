// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/value.h"

#include "materialNetwork/color/colorSpaces.h"

#include <cmath>
#include <cstdio>

namespace patina {

namespace {

bool isNumeric(ValueType type) {
    return valueTypeComponents(type) > 0;
}
bool isScalar(ValueType type) {
    return type == ValueType::Bool || type == ValueType::Int || type == ValueType::Float;
}
bool isMatrix(ValueType type) {
    return type == ValueType::Matrix33 || type == ValueType::Matrix44;
}

} // namespace

Coercion coercion(ValueType from, ValueType to) {
    if (from == to) return Coercion::Free;
    const bool texts = (from == ValueType::String && to == ValueType::Filename) ||
                       (from == ValueType::Filename && to == ValueType::String);
    if (texts) return Coercion::Free;
    if (!isNumeric(from) || !isNumeric(to) || isMatrix(from) || isMatrix(to)) return Coercion::None;
    if (isScalar(from)) return Coercion::Free;
    const int n = valueTypeComponents(from), m = valueTypeComponents(to);
    if (m == 1) return Coercion::None;
    if (n >= m) return Coercion::Free;
    if (n == 3 && m == 4) return Coercion::AppendOne;
    return n == 2 && m == 3 ? Coercion::Append : Coercion::None;
}

bool coerceValue(const Value& from, const InputDef& to, Value& out,
                 std::optional<Message>& problem) {
    problem.reset();
    out = from;
    out.type = to.type;
    if (from.type == ValueType::String && isNumeric(to.type)) {
        for (size_t i = 0; i < to.enumNames.size(); ++i)
            if (to.enumNames[i] == from.text) {
                out.numbers = {to.enumValues[i]};
                out.text.clear();
                return true;
            }
        problem = messages::textUnfit(from.text, valueTypeName(to.type));
        return false;
    }
    const Coercion c = coercion(from.type, to.type);
    if (c == Coercion::None) {
        problem = messages::valueTypeDiffers(valueTypeName(from.type), valueTypeName(to.type));
        return false;
    }
    if (!isNumeric(to.type)) return true;
    const auto finite = [&](const std::vector<float>& numbers) {
        for (const float x : numbers)
            if (!std::isfinite(x)) problem = messages::valueNotFinite;
        return !problem;
    };
    if (!finite(from.numbers)) return false;
    const size_t n = size_t(valueTypeComponents(to.type));
    if (from.numbers.empty()) {
        problem = messages::valueMissing;
        return false;
    }
    const float fill = from.numbers.size() == 1   ? from.numbers[0]
                       : c == Coercion::AppendOne ? 1.0f
                                                  : 0.0f;
    out.numbers.resize(n, fill);
    if (to.type == ValueType::Color3 || to.type == ValueType::Color4) {
        const bool known = ColorSpaces::shared().valueToRec709(from.colorSpace, out.numbers.data());
        if (!finite(out.numbers)) return false; // curves may overflow
        if (!known) problem = messages::valueSpaceUnknown(from.colorSpace);
    }
    if (to.type != ValueType::Filename) out.colorSpace.clear();
    return true;
}

int registerCount(ValueType type) {
    return type == ValueType::Matrix33 ? 3 : type == ValueType::Matrix44 ? 4 : 1;
}

void valueRows(const Value& value, glm::vec4* rows) {
    const std::vector<float>& v = value.numbers;
    const size_t columns = v.size() == 9 ? 3 : 4;
    rows[0] = glm::vec4(v.size() == 1 ? v[0] : 0.0f);
    for (size_t i = 1; i * columns < v.size(); ++i)
        rows[i] = glm::vec4(0.0f);
    for (size_t i = 0; v.size() > 1 && i < v.size(); ++i)
        rows[i / columns][int(i % columns)] = v[i];
}

bool sameValue(const Value& a, const Value& b) {
    return a.type == b.type && a.numbers == b.numbers && a.text == b.text &&
           a.colorSpace == b.colorSpace;
}

std::string valueText(const Value& value) {
    if (valueTypeComponents(value.type) == 0)
        return isClosureType(value.type)
                   ? "none"
                   : "'" + value.text + "'" +
                         (value.colorSpace.empty() ? "" : " [" + value.colorSpace + "]");
    bool uniform = true;
    for (const float x : value.numbers)
        uniform &= x == value.numbers[0];
    std::string text;
    for (size_t i = 0; i < value.numbers.size(); ++i) {
        char number[32];
        std::snprintf(number, sizeof number, "%.6g", double(value.numbers[i]));
        text += (i ? " " : "") + std::string(number);
        if (uniform) break;
    }
    return text;
}

} // namespace patina

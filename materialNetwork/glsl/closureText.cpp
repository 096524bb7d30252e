// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/closureText.h"

namespace patina {

namespace {

bool isNothing(const std::string& value) {
    return value == "vec3(0.0)" || value == "layerEven(vec3(0.0))";
}

} // namespace

std::string ClosureText::written(const std::string& name,
                                 const std::vector<std::string>& arguments) {
    if (name == "closureSum" || name == "layerSum") {
        if (isNothing(arguments[0])) return arguments[1];
        if (isNothing(arguments[1])) return arguments[0];
    }
    std::string text = name + "(";
    for (const std::string& a : arguments)
        text += (&a == &arguments[0] ? "" : ", ") + a;
    return text + ")";
}

std::string ClosureText::named(const char* type, const std::string& value) {
    const bool isName = value.find('(') == std::string::npos;
    if (isName || isNothing(value)) return value;
    const std::string name = _prefix + std::to_string(_names++);
    line(std::string(type) + " " + name + " = " + value + ";");
    return name;
}

const std::string& ClosureText::factorOf(int i, const ClosureOp& op) {
    const auto known = _factors.find(i);
    return known != _factors.end() ? known->second
                                   : _factors.emplace(i, _registers(op.factor)).first->second;
}

} // namespace patina

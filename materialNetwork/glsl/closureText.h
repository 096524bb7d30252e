// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/closureTree.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace patina {

/// Text of a register, a vec4.
using GlslRegister = std::function<std::string(int)>;

/// Steps of a walk over a tree of closures as GLSL, see cpu/closureTree.h. Every use of a register
/// is asked for once, in the order of the steps.
class ClosureText {
public:
    using Number = std::string;
    using Color = std::string;
    using Light = std::string;
    template <class T, int> using List = std::vector<T>;

    /// @param prefix of the variables that are declared
    ClosureText(const GlslRegister& registers, std::string prefix)
        : _registers(registers), _prefix(std::move(prefix)) {}

    const std::string& text() const { return _text; }

    Number number(int r) const { return _registers(r) + ".x"; }
    Color color(int r) const { return _registers(r) + ".xyz"; }
    static Color grey(float x) { return x == 0.0f ? "vec3(0.0)" : "vec3(1.0)"; }
    Number share(int i, const ClosureOp& op) { return "unit(" + factorOf(i, op) + ".x)"; }
    Color factor(int i, const ClosureOp& op) { return factorOf(i, op) + ".xyz"; }

    template <class F, class... A>
    static std::string call(const std::string& name, F, const A&... arguments) {
        return written(name, {arguments...});
    }
    /// @returns a variable with the value
    std::string named(const char* type, const std::string& value);

protected:
    void line(const std::string& text) { _text += "    " + text + "\n"; }

private:
    static std::string written(const std::string& name, const std::vector<std::string>& arguments);
    const std::string& factorOf(int i, const ClosureOp& op);

    const GlslRegister& _registers;
    std::string _prefix, _text;
    std::map<int, std::string> _factors;
    int _names = 0;
};

} // namespace patina

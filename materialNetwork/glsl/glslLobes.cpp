// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslLobes.h"

#include "shaders/shaders.h"

#include <type_traits>
#include <vector>

namespace patina {

namespace {

/// As Arguments of cpu/lobeSetup.cpp, in text.
struct Arguments {
    const LobeTemplate& t;
    const std::function<std::string(Register)>& registers;
    std::vector<std::string> known;
    int next = 0;

    /// In the order of the inputs, whatever order the compiler evaluates operands in.
    const std::string& at(int i) {
        while (int(known.size()) <= i)
            known.push_back(registers(t.parameters[known.size()]));
        return known[size_t(i)];
    }
    std::string color(int i) { return at(i) + ".xyz"; }
    std::string pair(int i) { return at(i) + ".xy"; }
    std::string number(int i) { return at(i) + ".x"; }
    static std::string flag(bool b) { return b ? "true" : "false"; }
    /// The last arguments of an interface.
    std::string tail() const {
        return ", " + flag(t.flagA) + ", " + std::to_string(t.mode) + ", " +
               flag(t.sharedInterface) + ", " + std::to_string(t.compensate) + ")";
    }

    template <class T> std::string take() {
        if constexpr (std::is_same_v<T, bool>) return flag(t.flagA);
        if constexpr (std::is_same_v<T, int>) return std::to_string(t.variant);
        if constexpr (std::is_same_v<T, float>) return number(next++);
        if constexpr (std::is_same_v<T, glm::vec2>) return pair(next++);
        return color(next++);
    }
};

template <class L, class... A>
std::string setup(L (*)(A...), const std::string& prefix, Arguments a) {
    std::string text;
    ((text += (text.empty() ? "" : ", ") + a.take<A>()), ...);
    return prefix + "Setup(" + text + ")";
}

// Lobes whose set-up takes more than the inputs of a node.

std::string setup(decltype(&sh::orenNayarSetup), const std::string&, Arguments a) {
    return "orenNayarModel(" + a.color(0) + ", " + a.number(1) + ", " + a.flag(a.t.flagA) + ", " +
           std::to_string(a.t.methods.at(Choice::Diffuse)) + ")";
}

std::string setup(decltype(&sh::dielectricSetup), const std::string&, Arguments a) {
    return "dielectricSetup(" + a.color(0) + ", " + a.number(1) + ", " + a.pair(2) + a.tail();
}

std::string setup(decltype(&sh::conductorSetup), const std::string&, Arguments a) {
    const std::string metal = "conductorSetup(" + a.color(0) + ", " + a.color(1) + ", " +
                              a.pair(2) + ", " + a.flag(a.t.flagA) + ", " +
                              std::to_string(a.t.compensate) + ")";
    return a.t.film ? "conductorFilm(" + metal + ", " + a.number(3) + ", " + a.number(4) + ")"
                    : metal;
}

std::string setup(decltype(&sh::schlickSetup), const std::string&, Arguments a) {
    if (a.t.filmDielectric)
        return "filmDielectricSetup(" + a.color(0) + ", " + a.number(1) + ", " + a.pair(2) + ", " +
               a.number(3) + ", " + a.number(4) + a.tail();
    const std::string bare = "schlickSetup(" + a.color(0) + ", " + a.color(1) + ", " + a.color(2) +
                             ", " + a.number(3) + ", " + a.pair(4) + a.tail();
    return a.t.film ? "schlickFilm(" + bare + ", " + a.number(5) + ", " + a.number(6) + ")" : bare;
}

} // namespace

std::string glslLobeType(LobeKind kind) {
    std::string name = lobeRow(kind).prefix;
    name[0] = char(name[0] - 'a' + 'A');
    return name + "Lobe";
}

std::string glslLobeSetup(const LobeTemplate& t,
                          const std::function<std::string(Register)>& registers) {
    switch (t.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        return setup(&sh::prefix##Setup, #prefix, Arguments{t, registers, {}});
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: break; // is never among the lobes of a program
    }
    return "";
}

std::string glslLobeMethods(const LobeTemplate& t, const std::string& lobe) {
    std::string text;
    const auto setMethods = [&](const char* function, std::initializer_list<Choice> points) {
        std::string numbers;
        bool differs = false;
        for (const Choice point : points) {
            numbers += ", " + std::to_string(t.methods.at(point));
            differs |= t.methods.at(point) != 0;
        }
        if (differs) text += "    " + lobe + " = " + function + "(" + lobe + numbers + ");\n";
    };
#define PATINA_LOBE_METHODS(Kind, prefix, function, ...)                                           \
    if (t.kind == LobeKind::Kind) setMethods(#function, {__VA_ARGS__});
#include "materialNetwork/plan/choicePoints.inc"
    return text;
}

} // namespace patina

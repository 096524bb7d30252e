// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/lobeSetup.h"

#include <tuple>
#include <type_traits>

namespace patina {

namespace {

/// Parameters and what is known at compile time, as arguments of a lobe's setup one by one.
struct Arguments {
    const LobeTemplate& t;
    const glm::vec4* registers;
    float surroundingIor;
    int next = 0;

    glm::vec3 color(int i) const { return glm::vec3(registers[t.parameters[i]]); }
    glm::vec2 pair(int i) const { return glm::vec2(registers[t.parameters[i]]); }
    float number(int i) const { return registers[t.parameters[i]].x; }

    template <class T> T take() {
        if constexpr (std::is_same_v<T, bool>) {
            return t.flagA;
        } else if constexpr (std::is_same_v<T, int>) {
            return t.variant;
        } else if constexpr (std::is_same_v<T, float>) {
            return number(next++);
        } else {
            return T(registers[t.parameters[next++]]);
        }
    }
};

template <class L, class... A> void set(L& l, L (*setup)(A...), Arguments a) {
    const std::tuple<A...> arguments{a.take<A>()...}; // braces keep the order
    l = std::apply(setup, arguments);
}

// Lobes whose set-up takes more than the inputs of a node.

void set(sh::OrenNayarLobe& l, decltype(&sh::orenNayarSetup), const Arguments& a) {
    l = sh::orenNayarModel(a.color(0), a.number(1), a.t.flagA, a.t.methods.at(Choice::Diffuse));
}

void set(sh::DielectricLobe& l, decltype(&sh::dielectricSetup), const Arguments& a) {
    const LobeTemplate& t = a.t;
    l = sh::dielectricSetup(a.color(0), a.number(1) / a.surroundingIor, a.pair(2), t.flagA, t.mode,
                            t.sharedInterface, t.compensate);
    l.ndf = t.ndf;
}

void set(sh::ConductorLobe& l, decltype(&sh::conductorSetup), const Arguments& a) {
    const LobeTemplate& t = a.t;
    l = sh::conductorSetup(a.color(0), a.color(1), a.pair(2), t.flagA, t.compensate);
    l.ndf = t.ndf;
    if (t.film) l = sh::conductorFilm(l, a.number(3), a.number(4));
}

void set(sh::SchlickLobe& l, decltype(&sh::schlickSetup), const Arguments& a) {
    const LobeTemplate& t = a.t;
    if (t.filmDielectric) {
        // The phase in the film is that of its own ior: thickness times ior stays.
        const float n = a.surroundingIor;
        l = sh::filmDielectricSetup(a.color(0), a.number(1) / n, a.pair(2), a.number(3) * n,
                                    a.number(4) / n, t.flagA, t.mode, t.sharedInterface,
                                    t.compensate);
    } else {
        l = sh::schlickSetup(a.color(0), a.color(1), a.color(2), a.number(3), a.pair(4), t.flagA,
                             t.mode, t.sharedInterface, t.compensate);
        if (t.film) l = sh::schlickFilm(l, a.number(5), a.number(6));
    }
    l.ndf = t.ndf;
}

template <class L, class F, class... Points>
void applyMethods(L& l, F function, const MethodSet& methods, Points... points) {
    l = function(l, methods.at(points)...);
}

/// Methods of lobes in choicePoints.inc.
template <LobeKind kind, class L>
void setMethods([[maybe_unused]] L& l, [[maybe_unused]] const MethodSet& methods) {
#define PATINA_LOBE_METHODS(Kind, prefix, function, ...)                                           \
    if constexpr (kind == LobeKind::Kind)                                                          \
        applyMethods(                                                                              \
            l, [](const L& before, auto... m) { return sh::function(before, m...); }, methods,     \
            __VA_ARGS__);
#include "materialNetwork/plan/choicePoints.inc"
}

} // namespace

void setupLobe(const LobeTemplate& t, const glm::vec4* r, BsdfLobe& out, float surroundingIor) {
    switch (t.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        set(out.prefix, sh::prefix##Setup, Arguments{t, r, surroundingIor});                       \
        setMethods<LobeKind::Kind>(out.prefix, t.methods);                                         \
        return;
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: return;
    }
}

} // namespace patina

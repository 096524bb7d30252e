// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/lobeSetup.h"

#include "materialNetwork/cpu/lobeOps.h"

#include <algorithm>
#include <tuple>
#include <type_traits>

namespace patina {

namespace {

/// Parameters and what is known at compile time, as arguments of a lobe's setup one by one.
struct Arguments {
    const LobeTemplate& t;
    const glm::vec4* registers;
    float surroundingIor, leastRoughness;
    int next = 0;

    glm::vec3 color(int i) const { return glm::vec3(registers[t.parameters[i]]); }
    glm::vec2 roughness(int i) const {
        return glm::max(glm::vec2(registers[t.parameters[i]]), glm::vec2(leastRoughness));
    }
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
    l = sh::dielectricSetup(a.color(0), a.number(1) / a.surroundingIor, a.roughness(2), t.flagA,
                            t.mode, t.sharedInterface, t.compensate);
    l.ndf = t.ndf;
}

void set(sh::ConductorLobe& l, decltype(&sh::conductorSetup), const Arguments& a) {
    const LobeTemplate& t = a.t;
    l = sh::conductorSetup(a.color(0), a.color(1), a.roughness(2), t.flagA, t.compensate);
    l.ndf = t.ndf;
    if (t.film) l = sh::conductorFilm(l, a.number(3), a.number(4));
}

void set(sh::SchlickLobe& l, decltype(&sh::schlickSetup), const Arguments& a) {
    const LobeTemplate& t = a.t;
    if (t.filmDielectric) {
        // The phase in the film is that of its own ior: thickness times ior stays.
        const float n = a.surroundingIor;
        l = sh::filmDielectricSetup(a.color(0), a.number(1) / n, a.roughness(2), a.number(3) * n,
                                    a.number(4) / n, t.flagA, t.mode, t.sharedInterface,
                                    t.compensate);
    } else {
        l = sh::schlickSetup(a.color(0), a.color(1), a.color(2), a.number(3), a.roughness(4),
                             t.flagA, t.mode, t.sharedInterface, t.compensate);
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

bool isSmoother(const BsdfLobe& lobe, float alpha) {
    return withLobe(lobe, [=]([[maybe_unused]] const auto& l, auto traits) {
        if constexpr ((traits() & lobe::Microfacet) != 0)
            return std::min(l.alpha.x, l.alpha.y) < alpha;
        return false;
    });
}

} // namespace

void setupLobe(const LobeTemplate& t, const glm::vec4* r, BsdfLobe& out, float surroundingIor,
               float leastRoughness) {
    switch (t.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        set(out.prefix, sh::prefix##Setup, Arguments{t, r, surroundingIor, leastRoughness});       \
        setMethods<LobeKind::Kind>(out.prefix, t.methods);                                         \
        return;
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: return;
    }
}

bool setupLobeAt(const ProgramCode& code, size_t index, const glm::vec4* registers,
                 const ShadingPoint& point, BsdfLobe& out) {
    const LobeTemplate& t = code.lobes[index];
    const float least = code.hasPassThrough ? 0.0f : point.leastRoughness;
    if (t.constant) {
        out = code.prebuilt[index];
        if (point.surroundingIor == 1.0f && !isSmoother(out, least)) return true;
        registers = code.constants.data();
    } else {
        out.kind = t.kind;
        out.diffuse = t.diffuse;
        out.frame = t.frame;
    }
    setupLobe(t, registers, out, point.surroundingIor, least);
    return false;
}

} // namespace patina

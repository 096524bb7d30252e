#include "materialNetwork/cpu/lobeSetup.h"

#include "materialNetwork/nodes/nodeTable.h"

#include <tuple>
#include <type_traits>

namespace patina {

namespace {

/// Of the first node that makes each kind of lobe.
struct LobeInputs {
    std::vector<std::string> numbers;
    std::string flag;

    explicit LobeInputs(LobeKind kind) {
        for (const auto& def : NodeTable::get().all()) {
            if (!isLobe(def->closure) || lobeKind(def->closure) != kind) continue;
            for (const InputDef& input : def->inputs) {
                const bool isFlag = input.type == ValueType::Bool;
                if (isFlag && flag.empty()) flag = input.name;
                if (!isFlag && valueTypeComponents(input.type) > 0 && input.geomprop.empty() &&
                    input.name != "weight")
                    numbers.push_back(input.name);
            }
            return;
        }
    }
};

const LobeInputs& inputsOf(LobeKind kind) {
    static const LobeInputs table[] = {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit) LobeInputs(LobeKind::Kind),
#include "materialNetwork/lobeTable.inc"
        LobeInputs(LobeKind::Layered)};
    return table[int(kind)];
}

/// Parameters and what is known at compile time, as arguments of a lobe's setup one by one.
struct Arguments {
    const LobeTemplate& t;
    const glm::vec4* registers;
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

// Lobes with methods at choice points.

void set(sh::OrenNayarLobe& l, decltype(&sh::orenNayarSetup), const Arguments& a) {
    l = sh::orenNayarModel(a.color(0), a.number(1), a.t.flagA, int(a.t.diffuse));
}

void set(sh::DielectricLobe& l, decltype(&sh::dielectricSetup), const Arguments& a) {
    const LobeTemplate& t = a.t;
    l = sh::dielectricSetup(a.color(0), a.number(1), a.pair(2), t.flagA, t.mode, t.sharedInterface,
                            t.compensate);
    l.ndf = t.ndf;
    l = sh::dielectricMethods(l, t.albedo, t.sampling, t.fresnel);
}

void set(sh::ConductorLobe& l, decltype(&sh::conductorSetup), const Arguments& a) {
    const LobeTemplate& t = a.t;
    l = sh::conductorSetup(a.color(0), a.color(1), a.pair(2), t.flagA, t.compensate);
    l.ndf = t.ndf;
    if (t.film) l = sh::conductorFilm(l, a.number(3), a.number(4));
    l = sh::conductorMethods(l, t.albedo, t.sampling, t.filmMethod);
    l = sh::conductorFresnel(l, t.fresnel);
}

void set(sh::SchlickLobe& l, decltype(&sh::schlickSetup), const Arguments& a) {
    const LobeTemplate& t = a.t;
    if (t.filmDielectric) {
        l = sh::filmDielectricSetup(a.color(0), a.number(1), a.pair(2), a.number(3), a.number(4),
                                    t.flagA, t.mode, t.sharedInterface, t.compensate);
    } else {
        l = sh::schlickSetup(a.color(0), a.color(1), a.color(2), a.number(3), a.pair(4), t.flagA,
                             t.mode, t.sharedInterface, t.compensate);
        if (t.film) l = sh::schlickFilm(l, a.number(5), a.number(6));
    }
    l.ndf = t.ndf;
    l = sh::schlickMethods(l, t.albedo, t.sampling, t.filmMethod);
}

void set(sh::SheenLobe& l, decltype(&sh::sheenSetup), const Arguments& a) {
    l = sh::sheenSetup(a.color(0), a.number(1), a.t.variant);
    l = sh::sheenMethods(l, a.t.sheenAlbedo);
}

} // namespace

const std::vector<std::string>& lobeParameters(LobeKind kind) {
    return inputsOf(kind).numbers;
}

const std::string& lobeFlag(LobeKind kind) {
    return inputsOf(kind).flag;
}

void setupLobe(const LobeTemplate& t, const glm::vec4* r, BsdfLobe& out) {
    switch (t.prebuilt.kind) {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    case LobeKind::Kind:                                                                           \
        set(out.prefix, sh::prefix##Setup, Arguments{t, r});                                       \
        return;
#include "materialNetwork/lobeTable.inc"
    case LobeKind::Layered: return;
    }
}

} // namespace patina

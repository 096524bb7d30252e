// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace patina {

namespace lobe {
/// Properties of a kind of lobe that the rest of a material depends on.
enum Trait : unsigned {
    None = 0,
    Diffuse = 1,    ///< counts as diffuse light
    Transmits = 2,  ///< always sends light to the other side, for good
    Microfacet = 4, ///< of microfacets, with the methods of these
    Interface = 8,  ///< has an inside, and a scatter mode
    Covers = 16,    ///< in a layer the base gets what its albedo leaves
    Fibre = 32      ///< is light in a hair, not at a surface
};
constexpr Trait operator|(Trait a, Trait b) {
    return Trait(unsigned(a) | unsigned(b));
}
} // namespace lobe

enum class LobeKind : uint8_t {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit) Kind,
#include "materialNetwork/lobeTable.inc"
    Layered ///< a layer that is walked; is in no program
};

/// A row of lobeTable.inc.
struct LobeRow {
    const char* prefix;
    lobe::Trait traits;
    const char* probe;
    const char* lit;
};

inline constexpr LobeRow lobeRows[] = {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit) {#prefix, traits, probe, lit},
#include "materialNetwork/lobeTable.inc"
    {"", lobe::None, "other", "LOBE_OTHER"}};

constexpr const LobeRow& lobeRow(LobeKind kind) {
    return lobeRows[int(kind)];
}
constexpr bool lobeHas(LobeKind kind, lobe::Trait trait) {
    return (lobeRow(kind).traits & trait) != 0;
}

} // namespace patina

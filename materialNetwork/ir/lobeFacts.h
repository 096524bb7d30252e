// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/lobes.h"

#include "shaders/shaders.h"

#include <type_traits>
#include <utility>

// Which of the functions that a lobe may overload (shaders/shaders.h) its file has.

namespace patina {

#define PATINA_LOBE_FACT(Name, ...)                                                                \
    template <class L, class = void> struct Name : std::false_type {};                             \
    template <class L> struct Name<L, std::void_t<decltype(__VA_ARGS__)>> : std::true_type {}

PATINA_LOBE_FACT(LobeHasFix,
                 sh::lobeFix(std::declval<L&>(), glm::vec3(), std::declval<glm::vec3&>()));
PATINA_LOBE_FACT(LobeHasRoughness, sh::lobeRoughness(std::declval<L&>()));
PATINA_LOBE_FACT(LobeHasDelta, sh::lobeIsDelta(std::declval<L&>()));
#undef PATINA_LOBE_FACT

/// The same of a kind, for text.
struct LobeFacts {
    bool fix, roughness;
};

inline constexpr LobeFacts lobeFacts[] = {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit)                                              \
    {LobeHasFix<sh::Kind##Lobe>::value, LobeHasRoughness<sh::Kind##Lobe>::value},
#include "materialNetwork/lobeTable.inc"
    {false, false}}; // Layered

constexpr const LobeFacts& lobeFactsOf(LobeKind kind) {
    return lobeFacts[int(kind)];
}

} // namespace patina

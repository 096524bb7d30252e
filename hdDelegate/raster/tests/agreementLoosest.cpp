// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/tests/loosest.h"
#include "shaders/tests/lobeCase.h"

namespace patina::shLoosest {

// Found by the types of what bindLobe() widens.
inline sh64::LobeEval widen(const LobeEval& e) {
    return {sh64::vec3(e.value), double(e.pdf)};
}
inline sh64::LobeSample widen(const LobeSample& s) {
    return {sh64::vec3(s.wi), sh64::vec3(s.weight), double(s.pdf), s.event, double(s.eta)};
}

} // namespace patina::shLoosest

#define PATINA_SINGLE shLoosest
#define PATINA_ROWS loosestRows
#include "hdDelegate/raster/tests/agreementRows.cpp"

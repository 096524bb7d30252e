// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/aovTable.h"

#include <algorithm>
#include <sstream>

namespace patina {

const std::vector<AovRow>& aovRows() {
    static const std::vector<AovRow> rows = [] {
        std::vector<AovRow> made;
        constexpr AovKind Mean = AovKind::Mean, First = AovKind::First,
                          Coverage = AovKind::Coverage;
        const auto row = [](AovId id, const char* name, int components, AovKind kind,
                            double clear) {
            AovRow r;
            r.id = id;
            r.name = name;
            r.components = components;
            r.kind = kind;
            r.clear = clear;
            return r;
        };
#define AOV(name, components, kind, clear, text, ...)                                              \
    made.push_back(row(AovId::name, #name, components, kind, clear) __VA_ARGS__);
#include "hdDelegate/film/aovs.def"
#undef AOV
        return made;
    }();
    return rows;
}

LightPathAovName lightPathAovOf(const std::string& aov) {
    const size_t at = aov.find(lightPathAovs);
    if (at == std::string::npos || (at > 0 && aov[at - 1] != '=')) return {};
    LightPathAovName result;
    result.expression = aov.substr(at + sizeof lightPathAovs - 1);
    if (at > 0) {
        result.name = aov.substr(0, at - 1);
        return result;
    }
    // Dots part layers from channels in OpenEXR, and other signs mean something to readers.
    result.name = "lpe_";
    for (const char c : result.expression)
        result.name +=
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c : '_';
    return result;
}

std::string channelsOfAov(const std::string& aov) {
    return aovIdOf(aov) == AovId::lpe ? lightPathAovOf(aov).name : aov;
}

std::string aovNamed(const std::string& source) {
    for (const AovRow& row : aovRows()) {
        std::istringstream aliases(row.aliases);
        for (std::string alias; aliases >> alias;)
            if (alias == source) return row.name;
    }
    return source;
}

AovId aovIdOf(const std::string& name) {
    const std::string prefix = primvarAovs;
    if (name.compare(0, prefix.size(), prefix) == 0)
        return name.size() > prefix.size() ? AovId::primvars : AovId::unknown;
    if (!lightPathAovOf(name).expression.empty()) return AovId::lpe;
    for (const AovRow& row : aovRows())
        if (row.id != AovId::primvars && row.id != AovId::lpe && name == row.name) return row.id;
    return AovId::unknown;
}

int cryptomatteLayerOf(const std::string& name, std::string& aov) {
    const size_t digits = 2;
    if (name.size() <= digits) return -1;
    const std::string number = name.substr(name.size() - digits);
    const std::string base = aovNamed(name.substr(0, name.size() - digits));
    const AovId id = aovIdOf(base);
    if (id == AovId::unknown || aovRows()[size_t(id)].kind != AovKind::Coverage) return -1;
    if (number[0] != '0' || number[1] < '0' || number[1] >= '8') return -1;
    aov = base;
    return number[1] - '0';
}

bool isOfFilm(const std::string& aov) {
    const AovId id = aovIdOf(aov);
    return id != AovId::unknown && aovRows()[size_t(id)].ofFilm;
}

bool tellMotion(const std::vector<std::string>& aovs) {
    return std::any_of(aovs.begin(), aovs.end(), [](const std::string& aov) {
        const AovId id = aovIdOf(aov);
        return id == AovId::motionForward || id == AovId::motionBackward;
    });
}

} // namespace patina

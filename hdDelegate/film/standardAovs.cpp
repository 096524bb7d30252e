// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/cryptomatte.h"
#include "hdDelegate/film/film.h"

#include <cstring>
#include <stdexcept>

namespace patina {

namespace {

float intBits(int32_t value) {
    float bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

bool startsWith(const std::string& text, const char* start) {
    return text.compare(0, std::strlen(start), start) == 0;
}

int primvarComponents(const std::string& primvar) {
    if (startsWith(primvar, "st") || startsWith(primvar, "uv") || startsWith(primvar, "UV"))
        return 2;
    return primvar == "displayOpacity" || primvar == "widths" ? 1 : 3;
}

} // namespace

AovSpec standardAov(const std::string& name) {
    const AovId id = aovIdOf(name);
    if (id == AovId::unknown) {
        std::string known;
        for (const AovRow& row : aovRows())
            if (row.id != AovId::primvars)
                known += (known.empty() ? "" : ", ") + std::string(row.name);
        throw std::invalid_argument("unknown AOV '" + name + "'; known are " + known + " and " +
                                    primvarAovs + "NAME");
    }
    const AovRow& row = aovRows()[size_t(id)];
    const float clear = row.isInteger ? intBits(int32_t(row.clear)) : float(row.clear);
    AovSpec spec{name, row.components, row.kind, clear, row.isInteger, id, {}};
    if (id == AovId::primvars) {
        spec.primvar = name.substr(sizeof primvarAovs - 1);
        spec.components = primvarComponents(spec.primvar);
    }
    return spec;
}

std::vector<AovSpec> renderedAovs(const std::vector<std::string>& names, int cryptomatteLevels) {
    std::vector<AovSpec> aovs;
    for (const std::string& name : names) {
        const AovId id = aovIdOf(name);
        if (id != AovId::unknown && aovRows()[size_t(id)].ofFilm) continue;
        aovs.push_back(standardAov(name));
        if (aovs.back().kind == AovKind::Coverage)
            aovs.back().components = cryptomatteComponents(cryptomatteLevels);
    }
    return aovs;
}

} // namespace patina

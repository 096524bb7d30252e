// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/aovTable.h"

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
    for (const AovRow& row : aovRows())
        if (row.id != AovId::primvars && name == row.name) return row.id;
    return AovId::unknown;
}

} // namespace patina

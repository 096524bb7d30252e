// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/cryptomatte.h"
#include "hdDelegate/film/film.h"
#include "hdDelegate/film/lightPaths/lightPathAutomaton.h"

#include <cctype>
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

constexpr size_t longestExpression = 1024;

/// @throws std::invalid_argument
void checkLightPath(const std::string& aov) {
    const LightPathAovName parts = lightPathAovOf(aov);
    if (parts.expression.size() > longestExpression)
        throw std::invalid_argument("AOV '" + parts.name +
                                    "': a light path expression has at most " +
                                    std::to_string(longestExpression) + " characters");
    for (const char c : parts.name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != ':')
            throw std::invalid_argument("AOV '" + aov + "': its name '" + parts.name +
                                        "' may have letters, digits, _, - and : only");
    if (parts.name.empty())
        throw std::invalid_argument("AOV '" + aov + "': there is no name before =");
    if (aovIdOf(parts.name) != AovId::unknown)
        throw std::invalid_argument("AOV '" + aov + "': '" + parts.name +
                                    "' is the name of another AOV");
    LightPathSet({parts.expression}); // says what is wrong with it
}

} // namespace

AovSpec standardAov(const std::string& name) {
    const AovId id = aovIdOf(name);
    if (id == AovId::unknown) {
        std::string known;
        for (const AovRow& row : aovRows())
            if (row.id != AovId::primvars && row.id != AovId::lpe && !isOfQuarters(row.id))
                known += (known.empty() ? "" : ", ") + std::string(row.name);
        throw std::invalid_argument("unknown AOV '" + name + "'; known are " + known + ", " +
                                    primvarAovs + "NAME and NAME=" + lightPathAovs + "EXPRESSION");
    }
    const AovRow& row = aovRows()[size_t(id)];
    const float clear = row.isInteger ? intBits(int32_t(row.clear)) : float(row.clear);
    AovSpec spec{name, row.components, row.kind, clear, row.isInteger, id, {}, {}};
    if (id == AovId::primvars) {
        spec.primvar = name.substr(sizeof primvarAovs - 1);
        spec.components = primvarComponents(spec.primvar);
    }
    if (id == AovId::lpe) {
        checkLightPath(name);
        spec.paths = lightPathAovOf(name).expression;
    }
    if (row.expression) spec.paths = row.expression;
    if (row.primvar) spec.primvar = row.primvar;
    return spec;
}

std::vector<Message> leaveOutLightPaths(std::vector<std::string>& names) {
    LightPathRoom room;
    std::vector<std::string> kept;
    std::vector<Message> problems;
    for (const std::string& name : names) {
        const AovId id = aovIdOf(name);
        std::string expression = lightPathAovOf(name).expression;
        if (id != AovId::unknown && aovRows()[size_t(id)].expression)
            expression = aovRows()[size_t(id)].expression;
        try {
            if (!expression.empty()) room.add(expression);
            kept.push_back(name);
        } catch (const std::invalid_argument& error) {
            problems.push_back(messages::aovPathLeftOut(channelsOfAov(name), error.what()));
        }
    }
    names = std::move(kept);
    return problems;
}

std::vector<AovSpec> renderedAovs(const std::vector<std::string>& names, int cryptomatteLevels) {
    std::vector<AovSpec> aovs;
    for (const std::string& name : names) {
        if (isOfFilm(name)) continue;
        if (isOfQuarters(aovIdOf(name)))
            throw std::invalid_argument("AOV '" + name + "' is of no picture: renderers keep it");
        aovs.push_back(standardAov(name));
        if (aovs.back().kind == AovKind::Coverage)
            aovs.back().components = cryptomatteComponents(cryptomatteLevels);
    }
    return aovs;
}

} // namespace patina

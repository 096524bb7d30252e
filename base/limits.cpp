// SPDX-License-Identifier: Apache-2.0
#include "base/limits.h"

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace patina {

namespace {

struct Row {
    const char* name;
    uint64_t initial, least, most;
};

constexpr Row rows[] = {
#define LIMIT(name, initial, least, most, ...) {#name, initial, least, most},
#include "base/limits.def"
#undef LIMIT
};
constexpr size_t count = std::size(rows);
using Values = std::array<uint64_t, count>;

/// @returns why it cannot be; else the value is taken
std::string change(Values& values, const std::string& name, uint64_t value) {
    for (size_t i = 0; i < count; ++i) {
        if (name != rows[i].name) continue;
        if (value < rows[i].least || value > rows[i].most)
            return "the limit " + name + " is from " + std::to_string(rows[i].least) + " to " +
                   std::to_string(rows[i].most);
        values[i] = value;
        return {};
    }
    std::string names;
    for (const Row& row : rows)
        names += (names.empty() ? "" : ", ") + std::string(row.name);
    return "there is no limit '" + name + "' (there are: " + names + ")";
}

Values defaults() {
    Values values;
    for (size_t i = 0; i < count; ++i)
        values[i] = rows[i].initial;
    const char* named = std::getenv("PATINA_LIMITS");
    std::istringstream words(named ? named : "");
    for (std::string word; words >> word;) {
        const size_t equals = word.find('=');
        char* end = nullptr;
        const std::string number = equals == std::string::npos ? "" : word.substr(equals + 1);
        const uint64_t value = std::strtoull(number.c_str(), &end, 10);
        const bool isNumber = !number.empty() && number[0] != '-' && *end == 0;
        const std::string problem = isNumber ? change(values, word.substr(0, equals), value)
                                             : "'" + word + "' is not NAME=NUMBER";
        // No scene is there yet that could be told.
        if (!problem.empty()) std::fprintf(stderr, "patina: PATINA_LIMITS: %s\n", problem.c_str());
    }
    return values;
}

struct Current {
    const Values initial = defaults();
    std::array<std::atomic<uint64_t>, count> values;

    Current() { take(initial); }
    void take(const Values& from) {
        for (size_t i = 0; i < count; ++i)
            values[i].store(from[i], std::memory_order_relaxed);
    }
};

Current& current() {
    static Current found;
    return found;
}

} // namespace

uint64_t limitOf(Limit limit) {
    return current().values[size_t(limit)].load(std::memory_order_relaxed);
}

std::string limitText(Limit limit) {
    return std::to_string(limitOf(limit)) + " (--limit " + rows[size_t(limit)].name + ")";
}

std::string setLimits(const std::map<std::string, uint64_t>& values) {
    Values after = current().initial;
    for (const auto& [name, value] : values) {
        const std::string problem = change(after, name, value);
        if (!problem.empty()) return problem;
    }
    current().take(after);
    return {};
}

} // namespace patina

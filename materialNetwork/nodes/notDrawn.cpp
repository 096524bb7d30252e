// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/nodes/notDrawn.h"

namespace patina {

namespace {

const struct {
    const char* ids;
    const char* reason;
} rows[] = {
#define PATINA_NOT_DRAWN(ids, reason) {ids, reason},
#include "materialNetwork/nodes/notDrawn.inc"
};

/// @param pattern with stars for any text
bool matches(const char* pattern, const char* text) {
    if (*pattern == '*') {
        for (const char* rest = text;; ++rest) {
            if (matches(pattern + 1, rest)) return true;
            if (!*rest) return false;
        }
    }
    return *pattern == *text && (!*pattern || matches(pattern + 1, text + 1));
}

} // namespace

const char* whyNotDrawn(const std::string& id) {
    constexpr size_t longest = 100; // ids are short, and stars try every end of a text
    if (id.size() > longest) return nullptr;
    // A document names what nobody knows by its category.
    const std::string definition = id.compare(0, 3, "ND_") == 0 ? id : "ND_" + id;
    for (const auto& row : rows)
        if (matches(row.ids, definition.c_str())) return row.reason;
    return nullptr;
}

} // namespace patina

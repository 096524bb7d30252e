// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Puts spaces for a part of a text. Lines stay.
inline void blank(std::string& text, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
        if (text[i] != '\n') text[i] = ' ';
}

/// Blanks comments.
inline std::string withoutComments(std::string text) {
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] != '/' || (text[i + 1] != '/' && text[i + 1] != '*')) continue;
        const bool line = text[i + 1] == '/';
        const size_t found = text.find(line ? "\n" : "*/", i + 2);
        const size_t end = found == std::string::npos ? text.size() : found + (line ? 0 : 2);
        blank(text, i, end);
        i = end - 1;
    }
    return text;
}

/// @returns where the line at `at` ends, with the lines that a backslash joins to it
inline size_t endOfLine(const std::string& text, size_t at) {
    for (;;) {
        size_t end = text.find('\n', at);
        if (end == std::string::npos) return text.size();
        if (end == 0 || text[end - 1] != '\\') return end;
        at = end + 1;
    }
}

} // namespace patina

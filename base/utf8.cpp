// SPDX-License-Identifier: Apache-2.0
#include "base/utf8.h"

namespace patina {

namespace {

/// @returns bytes of the character that begins there; 0: none does
size_t lengthAt(const std::string& text, size_t at) {
    const auto byte = [&](size_t i) {
        return at + i < text.size() ? unsigned(static_cast<unsigned char>(text[at + i])) : 0u;
    };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const size_t length = first >= 0xC2 && first < 0xE0   ? 2
                          : first >= 0xE0 && first < 0xF0 ? 3
                          : first >= 0xF0 && first < 0xF5 ? 4
                                                          : 0;
    for (size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    // Characters written longer than needed, halves of UTF-16's pairs, and beyond the last one.
    const unsigned second = byte(1);
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90))
        return 0;
    return length;
}

} // namespace

std::string validUtf8(const std::string& text) {
    std::string valid;
    valid.reserve(text.size());
    for (size_t at = 0; at < text.size();) {
        const size_t length = lengthAt(text, at);
        if (length)
            valid.append(text, at, length);
        else
            valid += "\xEF\xBF\xBD";
        at += length ? length : 1;
    }
    return valid;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
// Messages are UTF-8, whatever bytes a file holds.
#include "base/diagnostics.h"
#include "base/utf8.h"

#include <gtest/gtest.h>

namespace patina {

TEST(Utf8, ValidTextsStay) {
    for (const char* text : {"", "plain", "Gr\xC3\xBC\xC3\x9F", "\xE2\x82\xAC", "\xF0\x9F\x8C\x8D",
                             "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF", "\xE0\xA0\x80"})
        EXPECT_EQ(validUtf8(text), text);
}

TEST(Utf8, EveryByteOfNoCharacterIsReplaced) {
    const std::string r = "\xEF\xBF\xBD";
    EXPECT_EQ(validUtf8(std::string("a\xFF") + "b"), "a" + r + "b");
    EXPECT_EQ(validUtf8("\xC3"), r);                         // cut
    EXPECT_EQ(validUtf8("\xE2\x82"), r + r);                 // cut
    EXPECT_EQ(validUtf8("\xC0\xAF"), r + r);                 // a slash, longer than needed
    EXPECT_EQ(validUtf8("\xE0\x80\xAF"), r + r + r);         // likewise
    EXPECT_EQ(validUtf8("\xED\xA0\x80"), r + r + r);         // half of a pair
    EXPECT_EQ(validUtf8("\xF4\x90\x80\x80"), r + r + r + r); // beyond the last character
    EXPECT_EQ(validUtf8("\x80\xC3\xBC"), r + "\xC3\xBC");
}

TEST(Utf8, WarningsAreUtf8) {
    Diagnostics diagnostics;
    diagnostics.warn("/a\xFF", "\xFE", messages::fileMissing("\xC3"));
    const Diagnostic found = diagnostics.all().at(0);
    for (const std::string& text : {found.prim, found.input, found.message, found.what.fields[0]})
        EXPECT_EQ(validUtf8(text), text);
    diagnostics.warn("/a\xFF", "\xFE", messages::fileMissing("\xC3"));
    EXPECT_EQ(diagnostics.count(), 1);
}

} // namespace patina

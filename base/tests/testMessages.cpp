// SPDX-License-Identifier: Apache-2.0
// Messages, who gathers them, and that they are UTF-8, whatever bytes a file holds.
#include "base/diagnostics.h"
#include "base/messages.h"
#include "base/utf8.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

using namespace patina;

TEST(Messages, FieldsComeInTheOrderOfTheRow) {
    const Message message = messages::fileSpaceUnknown("acescg", std::string("a.png"));
    EXPECT_EQ(message.id, MessageId::fileSpaceUnknown);
    EXPECT_EQ(fieldNames(message.id), (std::vector<std::string>{"space", "file"}));
    EXPECT_EQ(message.text(), "unknown colour space 'acescg' of 'a.png'; its values are used as "
                              "they are");
    EXPECT_EQ(messages::fieldOfViewTooWide(179).text(),
              "is more than the 179 degrees that this projection can show; 179 are used");
    EXPECT_EQ(Message(messages::notFinite).text(), "is not a finite number; the fallback is used");
}

TEST(Messages, FieldsAreNoTemplates) {
    EXPECT_EQ(messages::referenceWithout("{target}", "{").text(), "{target} has no {");
}

TEST(Messages, PythonNamesThem) {
    EXPECT_EQ(messageOf("fileMissing", {"a"}).text(), messages::fileMissing("a").text());
    EXPECT_STREQ(nameOf(MessageId::fileMissing), "fileMissing");
    EXPECT_THROW(messageOf("fileMissing", {}), std::invalid_argument);
    EXPECT_THROW(messageOf("fileMissing", {"a", "b"}), std::invalid_argument);
    EXPECT_THROW(messageOf("fileIsMissing", {"a"}), std::invalid_argument);
}

TEST(Diagnostics, EqualWarningsAreCountedAndAReaderMeetsEachOnce) {
    Diagnostics diagnostics;
    size_t read = 0;
    diagnostics.warn("/a", "x", messages::notFinite);
    diagnostics.warn("/a", "x", messages::notFinite);
    diagnostics.warn("/ax", "", messages::notFinite); // the same text with the parts put together
    ASSERT_EQ(diagnostics.all().size(), 2u);
    EXPECT_EQ(diagnostics.all()[0].count, 2);
    EXPECT_EQ(diagnostics.news(read, 3).size(), 2u);
    EXPECT_TRUE(diagnostics.news(read, 3).empty());
    diagnostics.warn("/b", "x", messages::notFinite);
    ASSERT_EQ(diagnostics.news(read, 3).size(), 1u);
}

TEST(Diagnostics, LongSessionsForgetWhatTheyTold) {
    Diagnostics diagnostics;
    size_t read = 0, told = 0, most = 0;
    for (int i = 0; i < 100; ++i) {
        diagnostics.warn("/a", "x", messages::basisUnknown(i));
        told += diagnostics.news(read, 10).size();
        most = std::max(most, diagnostics.all().size());
    }
    EXPECT_EQ(told, 100u);
    EXPECT_EQ(diagnostics.count(), 100);
    EXPECT_EQ(most, 10u);
    diagnostics.clear();
    diagnostics.warn("/a", "x", messages::basisUnknown(99));
    EXPECT_EQ(diagnostics.count(), 1);
}

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

// SPDX-License-Identifier: Apache-2.0
#include "base/messages.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace patina {

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

} // namespace patina

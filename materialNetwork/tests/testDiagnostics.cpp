// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patina {

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

} // namespace patina

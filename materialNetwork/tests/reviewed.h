// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace patina {

/// Compares a text with that of a reviewed file of PATINA_EXPECTED_DIR. After a wanted change run
/// with PATINA_UPDATE_EXPECTED=1, and review the difference.
inline void expectReviewed(const std::string& path, const std::string& text) {
    if (std::getenv("PATINA_UPDATE_EXPECTED")) {
        std::ofstream(path) << text;
        return;
    }
    std::ifstream file(path);
    ASSERT_TRUE(file) << path << " is missing";
    std::ostringstream reviewed;
    reviewed << file.rdbuf();
    EXPECT_EQ(reviewed.str(), text) << path;
}

} // namespace patina

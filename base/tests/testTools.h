// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace patina {

inline std::string warnings(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& d : diagnostics.all())
        text += d.prim + " [" + d.input + "] " + d.message + "\n";
    return text;
}

/// Whether a text has that part; a failure shows the text.
inline testing::AssertionResult has(const std::string& text, const std::string& part) {
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess() << text;
    return testing::AssertionFailure() << "no '" << part << "' in\n" << text;
}

inline testing::AssertionResult told(const Diagnostics& diagnostics, const std::string& part) {
    return has(warnings(diagnostics), part);
}

inline testing::AssertionResult nothingTold(const Diagnostics& diagnostics) {
    if (diagnostics.count() == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << warnings(diagnostics);
}

/// @returns what an action throws; empty where it does not
inline std::string reasonOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

/// @returns the message of the one warning that there has to be
inline std::string onlyMessage(const Diagnostics& diagnostics) {
    EXPECT_EQ(diagnostics.count(), 1);
    return diagnostics.all().empty() ? "" : diagnostics.all()[0].message;
}
/// The same with what it is of: "prim input message".
inline std::string onlyWarning(const Diagnostics& diagnostics) {
    const std::string message = onlyMessage(diagnostics);
    if (diagnostics.all().empty()) return "";
    return diagnostics.all()[0].prim + " " + diagnostics.all()[0].input + " " + message;
}

/// Also where ids make numbers that are not equal to themselves.
inline bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

inline float floatOfBits(int32_t bits) {
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

inline std::string bytesOfFile(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}
inline void writeFile(const std::string& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

/// Does something on so many threads at once, and waits for all. @param work takes their number
inline void onThreads(int count, const std::function<void(int)>& work) {
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i)
        threads.emplace_back(work, i);
    for (std::thread& thread : threads)
        thread.join();
}

} // namespace patina

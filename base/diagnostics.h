// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>
#include <vector>

namespace patina {

/// One thing that was wrong with the input, and what was done instead.
struct Diagnostic {
    std::string prim;    ///< path of the prim (or file) it concerns
    std::string input;   ///< attribute or input, may be empty
    std::string message; ///< what is wrong and which fallback is used
    int count = 1;       ///< how often the same text was reported
};

/// Collects warnings from every room. Thread safe. Equal reports are counted, not repeated.
class Diagnostics {
public:
    void warn(const std::string& prim, const std::string& input, const std::string& message);
    std::vector<Diagnostic> all() const;
    int count() const; ///< number of different warnings
    void clear();

private:
    mutable std::mutex _mutex;
    std::vector<Diagnostic> _list;
};

} // namespace patina

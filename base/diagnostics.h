// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"

#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace patina {

/// One thing that was wrong with the input, and what was done instead.
struct Diagnostic {
    std::string prim;    ///< path of the prim (or file) it concerns
    std::string input;   ///< attribute or input, may be empty
    Message what;        ///< what is wrong and which fallback is used
    std::string message; ///< the same as text
    int count = 1;       ///< how often the same text was reported
};

/// Collects warnings from every room. Thread safe. Equal reports are counted, not repeated.
class Diagnostics {
public:
    void warn(const std::string& prim, const std::string& input, const Message& what);
    std::vector<Diagnostic> all() const;
    /// The warnings that are new to one reader, for long sessions: as soon as it has read more than
    /// `most`, all are forgotten, and one that comes again is new again.
    /// @param read of earlier calls; 0 at first
    std::vector<Diagnostic> news(size_t& read, size_t most);
    int count() const; ///< number of different warnings, with those that are forgotten
    void clear();

private:
    mutable std::mutex _mutex;
    std::vector<Diagnostic> _list;
    std::unordered_map<std::string, size_t> _places; ///< in _list, by all texts
    size_t _forgotten = 0;
};

} // namespace patina

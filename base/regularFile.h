// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/limits.h"

#include <cstdint>
#include <string>

namespace patina {

/// Files that a stage or a document names may be anything: a device gives bytes without end, a
/// named pipe waits for ever. Only regular files (or links to them) of a bounded size are read.

/// How many bytes of a file are read: a limit, or a number.
struct MostBytes {
    MostBytes(uint64_t number) : bytes(number), text(std::to_string(number)) {}
    MostBytes(Limit limit) : bytes(limitOf(limit)), text(limitText(limit)) {}
    uint64_t bytes;
    std::string text; ///< as messages name it
};

/// Why a file is not to be read, as in "is a named pipe, not a regular file"; empty when it may be.
/// Never waits. For readers that open the file themselves.
std::string whyUnreadable(const std::string& path, const MostBytes& most);

/// The same of an image, whatever its format. A file that begins with nothing but zeros is none:
/// there are readers that would look through all of it.
std::string whyNoImage(const std::string& path);

/// Reads all of a regular file.
/// @returns false, with the reason as above, when it is none, cannot be read or is larger
bool readRegularFile(const std::string& path, const MostBytes& most, std::string& bytes,
                     std::string& problem);

} // namespace patina

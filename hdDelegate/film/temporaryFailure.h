// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace patina {

/// A failure that may pass when tried again, without a change to what was asked for: the disk
/// was full, memory ran out, a server did not answer.
struct TemporaryFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// @param error as errno says it
inline bool isTemporary(int error) {
    for (int passing : {ENOSPC, EDQUOT, ENOMEM, EAGAIN, EINTR, EMFILE, ENFILE, EIO, ESTALE,
                        ETIMEDOUT, ENOLCK, EBUSY, ETXTBSY})
        if (error == passing) return true;
    return false;
}

/// @throws TemporaryFailure or std::runtime_error: the text, and what errno says
[[noreturn]] inline void failWith(const std::string& text, int error) {
    const std::string whole = text + ": " + std::strerror(error);
    if (isTemporary(error)) throw TemporaryFailure(whole);
    throw std::runtime_error(whole);
}

} // namespace patina

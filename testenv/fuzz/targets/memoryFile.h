// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace patina {

/// A regular file without a place on a disk, for readers that open a path.
class MemoryFile {
public:
    MemoryFile() : _file(::memfd_create("input", MFD_CLOEXEC)) {}
    ~MemoryFile() { ::close(_file); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    /// @returns the path of a file that holds these bytes, empty where the system gives none
    std::string with(const void* bytes, size_t size) {
        if (_file < 0 || ::ftruncate(_file, 0) != 0) return {};
        if (::pwrite(_file, bytes, size, 0) != ssize_t(size)) return {};
        return "/proc/self/fd/" + std::to_string(_file);
    }

private:
    int _file;
};

} // namespace patina

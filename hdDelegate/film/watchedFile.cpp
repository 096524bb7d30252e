// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/watchedFile.h"

#include <algorithm>
#include <cerrno>

namespace patina {

WatchedFile::WatchedFile(const std::string& path)
    : IOFile(OIIO::Filesystem::fopen(path, "w+b"), Write) {
    if (!m_file) _error = errno ? errno : EIO;
    m_filename = path;
    m_mode = Write; // also without a file: the library goes on, and finish() tells
}

WatchedFile::~WatchedFile() {
    finish();
}

size_t WatchedFile::pass(size_t written, size_t size, int64_t offset) {
    if (written == size) return size;
    if (!_error) _error = errno ? errno : EIO;
    m_pos = offset + int64_t(size);
    m_size = std::max(m_size, size_t(m_pos));
    return size;
}

size_t WatchedFile::write(const void* data, size_t size) {
    const int64_t offset = m_pos;
    errno = 0;
    return pass(_error ? size_t(0) : IOFile::write(data, size), size, offset);
}

size_t WatchedFile::pwrite(const void* data, size_t size, int64_t offset) {
    errno = 0;
    return pass(_error ? size_t(0) : IOFile::pwrite(data, size, offset), size, offset);
}

bool WatchedFile::seek(int64_t offset) {
    errno = 0;
    // Writes what the stream holds back: a small image comes to the disk here for the first time.
    if (!_error && !IOFile::seek(offset)) _error = errno ? errno : EIO;
    m_pos = offset;
    return true;
}

int WatchedFile::finish() {
    if (m_file) {
        errno = 0;
        if (std::fclose(m_file) != 0 && !_error) _error = errno ? errno : EIO;
        m_file = nullptr;
        m_mode = Closed;
    }
    return _error;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/filesystem.h>

#include <string>

namespace patina {

/// A file that image libraries write to, on a disk that may be full. Many of them look at no result
/// of writing, and libjpeg ends the process: so they are told that all went well, and problem()
/// says what did not.
class WatchedFile : public OIIO::Filesystem::IOFile {
public:
    explicit WatchedFile(const std::string& path);
    ~WatchedFile() override;

    /// Of a "file" OIIO would hand the stream itself to libjpeg.
    const char* proxytype() const override { return "watched"; }
    size_t write(const void* data, size_t size) override;
    size_t pwrite(const void* data, size_t size, int64_t offset) override;
    bool seek(int64_t offset) override;

    /// Closes the file. @returns why it is not whole, as errno says it, or 0
    int finish();

private:
    size_t pass(size_t written, size_t size, int64_t offset);

    int _error = 0;
};

} // namespace patina

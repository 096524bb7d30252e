// SPDX-License-Identifier: Apache-2.0
#include "testenv/fuzz/targets/scratchFiles.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace patina {

ScratchFiles::ScratchFiles() {
    _folder = (std::filesystem::temp_directory_path() / "patinaFuzzXXXXXX").string();
    if (!::mkdtemp(&_folder[0])) std::abort();
}

ScratchFiles::~ScratchFiles() {
    std::error_code ignored;
    std::filesystem::remove_all(_folder, ignored);
}

std::string ScratchFiles::write(const std::string& name, const void* bytes, size_t size) const {
    const std::string path = _folder + "/" + name;
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0 || ::write(file, bytes, size) != ssize_t(size)) std::abort();
    ::close(file);
    return path;
}

} // namespace patina

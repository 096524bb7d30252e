// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include <stdlib.h>

namespace patina {

/// A folder for the files of one test, removed at its end.
class TempFolder {
public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "patinaTest.XXXXXX").string();
        if (!mkdtemp(&name[0])) throw std::runtime_error("no temporary folder");
        _path = name;
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(_path, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    std::string file(const std::string& name) const { return (_path / name).string(); }
    size_t fileCount() const {
        size_t n = 0;
        for (auto& entry : std::filesystem::directory_iterator(_path))
            (void)entry, ++n;
        return n;
    }
    const std::filesystem::path& path() const { return _path; }

private:
    std::filesystem::path _path;
};

} // namespace patina

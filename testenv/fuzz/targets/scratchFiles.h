// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Files for readers that go by the names of files. They lie in a folder that goes with the object.
class ScratchFiles {
public:
    ScratchFiles();
    ~ScratchFiles();
    ScratchFiles(const ScratchFiles&) = delete;
    ScratchFiles& operator=(const ScratchFiles&) = delete;

    const std::string& folder() const { return _folder; }
    /// @param name in the folder
    /// @returns the path of a file that holds these bytes
    std::string write(const std::string& name, const void* bytes, size_t size) const;

private:
    std::string _folder;
};

} // namespace patina

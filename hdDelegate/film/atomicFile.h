// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// What happens to a link at the path of a file: what it leads to is replaced, or the link.
enum class Links { follow, replace };

/// A file that appears all at once: writers fill temporaryPath(), commit() renames it. When
/// commit() was not reached the temporary is removed, and what stood at the path stays as it was.
///
/// Only regular files and links are replaced. Temporaries that a
/// killed process has left of the same path are removed.
class AtomicFile {
public:
    /// The temporary lies beside the path and keeps its extension, for writers that look at it.
    /// @throws std::runtime_error when the folder does not exist or cannot be written, or when the
    ///         path is a folder, a device, a pipe, a socket, or a link to follow that leads to none
    explicit AtomicFile(const std::string& path, Links links = Links::follow);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::string& temporaryPath() const { return _temporary; }
    /// @throws std::runtime_error when the data does not reach the disk, or the file cannot be
    ///         renamed
    void commit();
    /// Ends without the file; nothing happens after commit().
    void discard();

private:
    std::string _path, _temporary;
    Links _links;
    int _lock = -1; ///< of the temporary, while it is being written
};

/// Says early why a file could not be written, without touching its folder.
/// @throws std::runtime_error as the constructor of AtomicFile
void checkOutput(const std::string& path);

} // namespace patina

#pragma once

#include <string>

namespace patina {

/// A file that appears all at once: writers fill temporaryPath(), commit() renames it. When
/// commit() was not reached the temporary is removed, and what stood at the path stays as it was.
class AtomicFile {
public:
    /// The temporary lies beside the path and keeps its extension, for writers that look at it.
    /// @throws std::runtime_error when the folder does not exist or cannot be written, or when the
    ///         path is a folder
    explicit AtomicFile(const std::string& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::string& temporaryPath() const { return _temporary; }
    /// @throws std::runtime_error when the file cannot be renamed
    void commit();

private:
    std::string _path, _temporary;
    bool _done = false;
};

} // namespace patina

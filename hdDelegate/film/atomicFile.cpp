#include "hdDelegate/film/atomicFile.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace patina {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw std::runtime_error("cannot write '" + path + "': " + reason);
}

} // namespace

AtomicFile::AtomicFile(const std::string& path) : _path(path) {
    static std::atomic<unsigned> counter{0};
    if (path.empty()) throw std::runtime_error("cannot write an image without a name");
    fs::path p(path);
    std::error_code error;
    // Through a link to its target: renaming over the link would turn it into a file.
    if (fs::is_symlink(p, error)) {
        fs::path target = fs::weakly_canonical(p, error);
        if (!error) p = target;
    }
    if (fs::is_directory(p, error)) fail(path, "it is a folder");
    fs::path folder = p.has_parent_path() ? p.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        fail(path, "the folder '" + folder.string() + "' does not exist");
    if (fs::exists(p, error) && ::access(p.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
    std::string unique = std::to_string(::getpid()) + "-" + std::to_string(counter++);
    _path = p.string();
    _temporary =
        (folder / ("." + p.stem().string() + "." + unique + p.extension().string())).string();
    int file = ::open(_temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file < 0) fail(path, std::strerror(errno));
    struct stat existing;
    if (::stat(_path.c_str(), &existing) == 0) ::fchmod(file, existing.st_mode & 07777);
    ::close(file);
}

AtomicFile::~AtomicFile() {
    if (!_done) std::remove(_temporary.c_str());
}

void AtomicFile::commit() {
    // The data must be on the disk before the name is, or a power cut leaves an empty file.
    int file = ::open(_temporary.c_str(), O_RDONLY | O_CLOEXEC);
    if (file >= 0) {
        ::fsync(file);
        ::close(file);
    }
    if (std::rename(_temporary.c_str(), _path.c_str()) != 0) fail(_path, std::strerror(errno));
    _done = true;
}

} // namespace patina

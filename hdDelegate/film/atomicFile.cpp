// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/atomicFile.h"

#include "hdDelegate/film/temporaryFailure.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace patina {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw std::runtime_error("cannot write '" + path + "': " + reason);
}
[[noreturn]] void fail(const std::string& path, int error) {
    failWith("cannot write '" + path + "'", error);
}

/// Renaming over a device or a pipe would put a file in its place.
/// @returns the file that is to be replaced
fs::path targetOf(const std::string& path, Links links) {
    struct stat found;
    if (::lstat(path.c_str(), &found) != 0) {
        if (errno == ENOENT || errno == ENOTDIR) return path;
        fail(path, errno);
    }
    const bool link = S_ISLNK(found.st_mode);
    if (link && links == Links::replace) return path;
    if (link && ::stat(path.c_str(), &found) != 0)
        fail(path, errno == ENOENT ? std::string("it is a link to nothing")
                                   : "it is a link: " + std::string(std::strerror(errno)));
    if (S_ISDIR(found.st_mode)) fail(path, "it is a folder");
    if (!S_ISREG(found.st_mode))
        fail(path, std::string("it is ") +
                       (S_ISFIFO(found.st_mode)   ? "a named pipe"
                        : S_ISSOCK(found.st_mode) ? "a socket"
                                                  : "a device") +
                       ", not a regular file");
    if (::access(path.c_str(), W_OK) != 0) fail(path, errno);
    if (!link) return path;
    std::error_code error;
    const fs::path target = fs::canonical(path, error);
    if (error) fail(path, error.message());
    return target;
}

fs::path folderOf(const std::string& path, const fs::path& target) {
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code error;
    if (!fs::is_directory(folder, error))
        fail(path, "the folder '" + folder.string() + "' does not exist");
    return folder;
}

/// @returns the file that is to be replaced
fs::path checkedTarget(const std::string& path, Links links = Links::follow) {
    if (path.empty()) throw std::runtime_error("cannot write an image without a name");
    if (path.find('\0') != std::string::npos) fail(path.c_str(), "its name holds a zero byte");
    return targetOf(path, links);
}

/// The beginning and the end of names of temporaries; between them are process and number.
std::string startOf(const fs::path& target) {
    const size_t room = NAME_MAX - 32 - std::min<size_t>(target.extension().native().size(), 64);
    return "." + target.stem().native().substr(0, room) + ".";
}
std::string endOf(const fs::path& target) {
    return target.extension().native().substr(0, 64);
}

bool isAlive(const std::string& process) {
    const long number = std::strtol(process.c_str(), nullptr, 10);
    return number > 0 && (::kill(pid_t(number), 0) == 0 || errno != ESRCH);
}

/// Removes temporaries of the same target whose process has ended, here and on other machines that
/// share the folder: those hold a lock.
void removeLeftOver(const fs::path& folder, const fs::path& target) {
    const std::string start = startOf(target), end = endOf(target);
    std::error_code error;
    for (fs::directory_iterator it(folder, error), last; !error && it != last;
         it.increment(error)) {
        const std::string name = it->path().filename().native();
        if (name.size() <= start.size() + end.size() || name.compare(0, start.size(), start) != 0 ||
            name.compare(name.size() - end.size(), end.size(), end) != 0)
            continue;
        const std::string unique =
            name.substr(start.size(), name.size() - start.size() - end.size());
        const size_t dash = unique.find('-');
        if (dash == std::string::npos || dash == 0 || dash + 1 == unique.size() ||
            unique.find('-', dash + 1) != std::string::npos || // a date of the user's
            unique.find_first_not_of("0123456789-") != std::string::npos ||
            isAlive(unique.substr(0, dash)))
            continue;
        const int file = ::open(it->path().c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
        if (file < 0) continue;
        struct stat found;
        if (::fstat(file, &found) == 0 && S_ISREG(found.st_mode) &&
            ::flock(file, LOCK_EX | LOCK_NB) == 0)
            ::unlink(it->path().c_str());
        ::close(file);
    }
}

} // namespace

AtomicFile::AtomicFile(const std::string& path, Links links) : _path(path), _links(links) {
    static std::atomic<unsigned> counter{0};
    const fs::path target = checkedTarget(path, links);
    const fs::path folder = folderOf(path, target);
    removeLeftOver(folder, target);
    _path = target.string();
    _temporary = (folder / (startOf(target) + std::to_string(::getpid()) + "-" +
                            std::to_string(counter++) + endOf(target)))
                     .string();
    _lock = ::open(_temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (_lock < 0) fail(path, errno);
    (void)::flock(_lock, LOCK_EX | LOCK_NB); // where there are no locks, the process says enough
    struct stat existing;
    if (::lstat(_path.c_str(), &existing) == 0 && S_ISREG(existing.st_mode)) {
        // Root alone may give files away. What another user's file allows is not taken over.
        const bool same = ::fchown(_lock, existing.st_uid, existing.st_gid) == 0;
        if (same || existing.st_uid == ::geteuid()) ::fchmod(_lock, existing.st_mode & 0777);
        errno = 0;
    }
}

void checkOutput(const std::string& path) {
    const fs::path folder = folderOf(path, checkedTarget(path));
    if (::access(folder.c_str(), W_OK | X_OK) != 0) fail(path, errno);
}

AtomicFile::~AtomicFile() {
    discard();
}

void AtomicFile::discard() {
    if (_lock < 0) return;
    ::close(_lock);
    _lock = -1;
    std::remove(_temporary.c_str());
}

void AtomicFile::commit() {
    if (_lock < 0) fail(_path, "it was written or given up before");
    // The data must be on the disk before the name is, or a power cut leaves an empty file. A full
    // disk is told here at the latest.
    const int file = ::open(_temporary.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) fail(_path, errno);
    const int problem = ::fsync(file) == 0 || errno == EINVAL ? 0 : errno;
    ::close(file);
    if (problem) fail(_path, problem);
    // Once more: something else may have come there since.
    if (targetOf(_path, _links).string() != _path) fail(_path, "it has become a link");
    if (std::rename(_temporary.c_str(), _path.c_str()) != 0) fail(_path, errno);
    ::close(_lock);
    _lock = -1;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "base/regularFile.h"

#include "base/exrClaims.h"
#include "base/imageProfile.h"
#include "base/trialRead.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace patina {

namespace {

const char* kindOf(mode_t mode) {
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a named pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return S_ISBLK(mode) || S_ISCHR(mode) ? "a device" : "something else";
}

std::string problemOf(const struct stat& found, const MostBytes& most) {
    if (!S_ISREG(found.st_mode))
        return std::string("is ") + kindOf(found.st_mode) + ", not a regular file";
    if (uint64_t(found.st_size) > most.bytes)
        return "holds " + std::to_string(found.st_size) + " bytes; at most " + most.text +
               " are read";
    return {};
}

std::string problemOf(int error) {
    if (error == ENOENT || error == ENOTDIR) return "does not exist";
    return "cannot be opened: " + std::string(std::strerror(error));
}

struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

} // namespace

std::string whyUnreadable(const std::string& path, const MostBytes& most) {
    struct stat found;
    if (::stat(path.c_str(), &found) != 0) return problemOf(errno);
    const std::string problem = problemOf(found, most);
    return problem.empty() && ::access(path.c_str(), R_OK) != 0 ? problemOf(errno) : problem;
}

std::string whyNoImage(const std::string& path) {
    const std::string problem = whyUnreadable(path, Limit::imageBytes);
    if (!problem.empty()) return problem;
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
    char start[4096];
    const ssize_t got = file.number < 0 ? -1 : ::read(file.number, start, sizeof start);
    const bool zeros = got == ssize_t(sizeof start) &&
                       std::all_of(start, start + got, [](char c) { return c == 0; });
    if (zeros) return "is no image: it begins with zeros";
    if (exrClaimsMore(file.number)) return "is no image: its header claims more than it holds";
    return whyTrialFails(path, mayHoldProfile(file.number));
}

bool readRegularFile(const std::string& path, const MostBytes& most, std::string& bytes,
                     std::string& problem) {
    bytes.clear();
    problem = whyUnreadable(path, most);
    if (!problem.empty()) return false;
    // Looked at once more when it is open: what a name stands for may change in between. Without
    // O_NONBLOCK a pipe would wait for its writer.
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
    struct stat found;
    if (file.number < 0 || ::fstat(file.number, &found) != 0) {
        problem = errno == ENXIO ? "is a socket or a device, not a regular file" : problemOf(errno);
        return false;
    }
    problem = problemOf(found, most);
    if (!problem.empty()) return false;
    bytes.reserve(size_t(found.st_size) + 1);
    char part[1 << 16];
    for (;;) { // to its end, whatever its size said: it may grow, and /proc tells none
        const ssize_t got = ::read(file.number, part, sizeof part);
        if (got == 0) return true;
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            problem = "cannot be read: " + std::string(std::strerror(errno));
        else if (uint64_t(got) > most.bytes - bytes.size())
            problem = "holds more bytes than the " + most.text + " that are read";
        if (!problem.empty()) {
            bytes.clear();
            return false;
        }
        bytes.append(part, size_t(got));
    }
}

} // namespace patina

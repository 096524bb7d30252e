// SPDX-License-Identifier: Apache-2.0
#include "base/trialRead.h"

#include "base/childProgram.h"
#include "base/limits.h"

#include <cerrno>
#include <chrono>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace patina {

namespace {

/// The program that tries images, one after another. A new one is started after each that died.
class Trials {
public:
    static Trials& get() {
        static Trials trials;
        return trials;
    }

    /// @param isWhole texels are read, too
    std::string of(const std::string& path, const struct stat& found, bool isWhole) {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (_process > 0 && _host != ::getpid()) { // forked since: the program is the parent's
            ::close(std::exchange(_socket, -1));
            _process = -1;
        }
        const std::string asked = (isWhole ? 't' : 'h') + path;
        const Key key{asked, found.st_size, found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
        const auto known = _answers.find(key);
        if (known != _answers.end()) return known->second;
        std::string answer;
        try {
            // A header takes no time: only a machine that is busy with other work keeps it waiting.
            answer = ask(asked, (isWhole ? 10 : 60) + (found.st_size >> 20));
        } catch (const std::exception& e) {
            if (isWhole) answer = std::string("cannot be tried: ") + e.what();
        }
        _answers[key] = answer;
        return answer;
    }

private:
    using Key = std::tuple<std::string, off_t, time_t, long>;

    ~Trials() { end(); }

    std::string ask(const std::string& asked, long seconds) {
        if (_process <= 0) start();
        if (!send(asked)) { // it has ended since: of that no file can be blamed
            end();
            start();
            if (!send(asked)) throw std::runtime_error("the program that does so ends" + end());
        }
        using Clock = std::chrono::steady_clock;
        const auto last = Clock::now() + std::chrono::seconds(seconds);
        for (;;) {
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(last - Clock::now()).count();
            pollfd wanted{_socket, POLLIN, 0};
            const int ready = left > 0 ? ::poll(&wanted, 1, int(left)) : 0;
            if (ready < 0 && errno == EINTR) continue;
            if (ready <= 0) {
                end();
                return "is not read by OpenImageIO within " + std::to_string(seconds) + " s";
            }
            char answer;
            const ssize_t got = ::recv(_socket, &answer, 1, 0);
            if (got < 0 && errno == EINTR) continue;
            if (got == 1 && answer == 'm') {
                end(); // what it holds is given back
                return "takes more memory than the limit textureBytes allows";
            }
            if (got == 1) return {};
            return "makes OpenImageIO fail" + end();
        }
    }

    bool send(const std::string& asked) const {
        const char* p = asked.c_str();
        for (size_t left = asked.size() + 1; left > 0;) { // its zero ends it
            const ssize_t sent = ::send(_socket, p, left, MSG_NOSIGNAL);
            if (sent < 0 && errno == EINTR) continue;
            if (sent <= 0) return false;
            p += sent;
            left -= size_t(sent);
        }
        return true;
    }

    void start() {
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
            throw std::runtime_error("no program can be started");
        try {
            _process =
                startProgram(programPath("patinaTryImage", PATINA_TRY_IMAGE),
                             {std::to_string(limitOf(Limit::textureBytes))}, ends[1], ends[1]);
            _host = ::getpid();
        } catch (...) {
            ::close(ends[0]);
            ::close(ends[1]);
            throw;
        }
        ::close(ends[1]);
        _socket = ends[0];
    }

    std::string end() {
        if (_socket >= 0) ::close(std::exchange(_socket, -1));
        return endProgram(std::exchange(_process, -1));
    }

    std::mutex _mutex;
    std::map<Key, std::string> _answers;
    pid_t _process = -1, _host = -1; ///< the program, and the process that started it
    int _socket = -1;
};

} // namespace

std::string whyTrialFails(const std::string& path, bool isRisky) {
    struct stat found;
    if (::stat(path.c_str(), &found) != 0) return {}; // its reader says so
#ifdef PATINA_FUZZ // of which a thousand inputs in a second make nothing
    isRisky = false;
#endif
    const bool isWhole = uint64_t(found.st_size) > limitOf(Limit::untriedBytes);
    return isWhole || isRisky ? Trials::get().of(path, found, isWhole) : std::string();
}

} // namespace patina

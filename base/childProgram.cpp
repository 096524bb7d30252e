// SPDX-License-Identifier: Apache-2.0
#include "base/childProgram.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace patina {

std::string programPath(const std::string& name, const std::string& built) {
    Dl_info here;
    if (::dladdr(reinterpret_cast<const void*>(&programPath), &here) && here.dli_fname) {
        const std::string library = here.dli_fname;
        const size_t slash = library.rfind('/');
        if (slash != std::string::npos) {
            const std::string folder = library.substr(0, slash + 1);
            // Beside it; or in the folder of an installed library, which the loader may have taken
            // from glibc-hwcaps/LEVEL.
            for (const char* place : {"", "patina/", "../../patina/"}) {
                const std::string program = folder + place + name;
                if (::access(program.c_str(), X_OK) == 0) return program;
            }
        }
    }
    return built;
}

pid_t startProgram(const std::string& program, const std::vector<std::string>& arguments, int input,
                   int output) {
    std::vector<char*> words{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments)
        words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, output, 1);
    if (input >= 0)
        posix_spawn_file_actions_adddup2(&files, input, 0);
    else
        posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 34)
    posix_spawn_file_actions_addclosefrom_np(&files, 3);
#endif
    posix_spawnattr_t attributes;
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    pid_t process = -1;
    const int error =
        ::posix_spawn(&process, program.c_str(), &files, &attributes, words.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (error)
        throw std::runtime_error("the program that reads it, " + program +
                                 ", cannot be run: " + std::strerror(error));
    return process;
}

std::string endProgram(pid_t program) {
    if (program <= 0) return {};
    ::kill(program, SIGKILL); // of one that has ended already nothing is changed
    int status = 0;
    pid_t waited;
    while ((waited = ::waitpid(program, &status, 0)) < 0 && errno == EINTR) {
    }
    if (waited < 0 || !WIFSIGNALED(status) || WTERMSIG(status) == SIGKILL) return {};
    return std::string(" (") + ::strsignal(WTERMSIG(status)) + ")";
}

} // namespace patina

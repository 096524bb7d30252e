// SPDX-License-Identifier: Apache-2.0
// Preloaded: the n-th call of a kind fails. Of calls that write, read or map, those on files below
// a folder count; of those for memory, large ones, or all that Patina's own C++ makes.
// test_faults.py and faults.py build it. Where the process dies afterwards, failNthDeath.h tells
// whose defect that is.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

static char folder[PATH_MAX];
static int failAt, count, problem;
static char failed[32], trace[1 << 16], kind[16] = "write";
static const size_t largePiece = 1 << 16;

#include "failNthDeath.h"

/// @param name write, read, map, memory or own
void failNthKind(const char* name) {
    strncpy(kind, name, sizeof kind - 1);
}

/// Begins anew. @param at of the call that fails, from 1; 0: none are looked at. @param number
/// errno's
void failNthBegin(const char* path, int at, int number) {
    strncpy(folder, path, sizeof folder - 1);
    failAt = at;
    problem = number;
    count = 0;
    failed[0] = trace[0] = 0;
    if (at) watchForDeath();
}
/// @returns the functions that were called while none was to fail, one on a line
const char* failNthTrace(void) {
    return trace;
}
/// @returns the function that has failed, or an empty text
const char* failNthWhich(void) {
    return failed;
}

static int countsCall(const char* name) {
    if (strlen(trace) + strlen(name) + 2 < sizeof trace) strcat(strcat(trace, name), "\n");
    if (++count != failAt) return 0;
    strcpy(failed, name);
    askedDepth = backtrace(asked, deepest);
    errno = problem;
    return 1;
}
/// Files are named in the way that the program names them: where a path is relative, the folder is
/// the working one.
static int countsKind(const char* path, const char* name, const char* of) {
    if (!failAt || !path || strcmp(kind, of) != 0) return 0;
    if (path[0] == '/' && strncmp(path, folder, strlen(folder)) != 0) return 0;
    return countsCall(name);
}
static int counts(const char* path, const char* name) {
    return countsKind(path, name, "write");
}
static int countsFileKind(int file, const char* name, const char* of) {
    char link[64], path[PATH_MAX];
    if (!failAt || strcmp(kind, of) != 0) return 0;
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t size = readlink(link, path, sizeof path - 1);
    if (size <= 0) return 0;
    path[size] = 0;
    if (path[0] != '/') return 0; // a pipe, a socket
    return countsKind(path, name, of);
}
static int countsFile(int file, const char* name) {
    return countsFileKind(file, name, "write");
}

#define NEXT(function)                                                                             \
    __typeof__(&function) next = (__typeof__(&function))dlsym(RTLD_NEXT, #function)

#define OPENER(name)                                                                               \
    int name(const char* path, int flags, ...) {                                                   \
        va_list more;                                                                              \
        va_start(more, flags);                                                                     \
        int mode = flags & O_CREAT ? va_arg(more, int) : 0;                                        \
        va_end(more);                                                                              \
        if ((flags & (O_WRONLY | O_RDWR | O_CREAT)) && counts(path, "open")) return -1;            \
        NEXT(name);                                                                                \
        return next(path, flags, mode);                                                            \
    }
OPENER(open)
OPENER(open64)

#define STREAM_OPENER(name)                                                                        \
    FILE* name(const char* path, const char* mode) {                                               \
        if (strpbrk(mode, "wa+") && counts(path, "fopen")) return NULL;                            \
        NEXT(name);                                                                                \
        return next(path, mode);                                                                   \
    }
STREAM_OPENER(fopen)
STREAM_OPENER(fopen64)

ssize_t write(int file, const void* data, size_t size) {
    if (countsFile(file, "write")) return -1;
    NEXT(write);
    return next(file, data, size);
}
ssize_t writev(int file, const struct iovec* parts, int number) {
    if (countsFile(file, "write")) return -1;
    NEXT(writev);
    return next(file, parts, number);
}
size_t fwrite(const void* data, size_t size, size_t number, FILE* file) {
    if (countsFile(fileno(file), "fwrite")) return 0;
    NEXT(fwrite);
    return next(data, size, number, file);
}
int fflush(FILE* file) {
    if (file && countsFile(fileno(file), "fflush")) return EOF;
    NEXT(fflush);
    return next(file);
}
int fclose(FILE* file) {
    int fails = countsFile(fileno(file), "fclose"), number = errno;
    NEXT(fclose);
    int done = next(file);
    if (fails) errno = number;
    return fails ? EOF : done;
}
int fsync(int file) {
    if (countsFile(file, "fsync")) return -1;
    NEXT(fsync);
    return next(file);
}
int rename(const char* from, const char* to) {
    if (counts(from, "rename")) return -1;
    NEXT(rename);
    return next(from, to);
}

#define READER(name, ...)                                                                          \
    NEXT(name);                                                                                    \
    return next(__VA_ARGS__);
ssize_t read(int file, void* data, size_t size) {
    if (countsFileKind(file, "read", "read")) return -1;
    READER(read, file, data, size)
}
ssize_t pread(int file, void* data, size_t size, off_t at) {
    if (countsFileKind(file, "pread", "read")) return -1;
    READER(pread, file, data, size, at)
}
size_t fread(void* data, size_t size, size_t number, FILE* file) {
    if (countsFileKind(fileno(file), "fread", "read")) return 0;
    READER(fread, data, size, number, file)
}
void* mmap(void* at, size_t size, int protection, int flags, int file, off_t from) {
    if (file >= 0 && countsFileKind(file, "mmap", "map")) return MAP_FAILED;
    READER(mmap, at, size, protection, flags, file, from)
}

// dlsym() allocates itself: glibc's own names need no look-up.
extern void* __libc_malloc(size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);
static int countsPiece(size_t size, const char* name) {
    return failAt && size >= largePiece && strcmp(kind, "memory") == 0 && countsCall(name);
}
void* malloc(size_t size) {
    return countsPiece(size, "malloc") ? NULL : __libc_malloc(size);
}
void* realloc(void* before, size_t size) {
    return countsPiece(size, "realloc") ? NULL : __libc_realloc(before, size);
}
int posix_memalign(void** result, size_t alignment, size_t size) {
    if (countsPiece(size, "memalign")) return ENOMEM;
    void* made = __libc_memalign(alignment, size);
    if (!made) return ENOMEM;
    *result = made;
    return 0;
}
void* aligned_alloc(size_t alignment, size_t size) {
    return countsPiece(size, "memalign") ? NULL : __libc_memalign(alignment, size);
}

// Patina's own allocations of any size: `new` fails by an exception. The module is loaded by then.
extern void _ZSt17__throw_bad_allocv(void); // std::__throw_bad_alloc()
static int asksForOwn(const void* caller) {
    return failAt && strcmp(kind, "own") == 0 && isPatinas(caller) && ++count == failAt;
}
static void* newPiece(size_t size, size_t alignment, const void* caller) {
    int fails = asksForOwn(caller);
    if (fails) {
        strcpy(failed, "new");
        askedDepth = backtrace(asked, deepest);
    }
    void* made = fails                           ? NULL
                 : alignment > 2 * sizeof(void*) ? __libc_memalign(alignment, size)
                                                 : __libc_malloc(size ? size : 1);
    if (!made) _ZSt17__throw_bad_allocv();
    return made;
}
void* _Znwm(size_t size) {
    return newPiece(size, 0, __builtin_return_address(0));
}
void* _Znam(size_t size) {
    return newPiece(size, 0, __builtin_return_address(0));
}
void* _ZnwmSt11align_val_t(size_t size, size_t alignment) {
    return newPiece(size, alignment, __builtin_return_address(0));
}
/// @returns how many calls of the kind were made
int failNthCount(void) {
    return count;
}

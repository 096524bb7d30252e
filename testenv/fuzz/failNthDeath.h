// SPDX-License-Identifier: Apache-2.0
// Tells whether a process that dies after a call has failed dies by another library's defect: that
// library made the call, and died before it returned to Patina. Then Patina never saw that the
// call had failed, and could not do better. Part of failNth.c.
#pragma once

#include <execinfo.h>
#include <link.h>
#include <signal.h>
#include <sys/auxv.h>

enum { deepest = 256 };
static void* asked[deepest];
static int askedDepth;
static struct sigaction handlersBefore[NSIG];

/// @returns the name of the object that holds an address, without its folder
static const char* objectOf(const void* address) {
    Dl_info found;
    if (!dladdr(address, &found) || !found.dli_fname) return "";
    const char* slash = strrchr(found.dli_fname, '/');
    return slash ? slash + 1 : found.dli_fname;
}

/// Whether an address is of Patina's module, which is loaded by the first failNthBegin().
static const char *moduleBegin, *moduleEnd;
static int isPatinas(const void* address) {
    return (const char*)address >= moduleBegin && (const char*)address < moduleEnd;
}
static int findModule(struct dl_phdr_info* object, size_t size, void* unused) {
    (void)size, (void)unused;
    const char* slash = object->dlpi_name ? strrchr(object->dlpi_name, '/') : NULL;
    if (!slash || strncmp(slash + 1, "_patina.", 8) != 0) return 0;
    for (int k = 0; k < object->dlpi_phnum; k++) {
        const ElfW(Phdr)* part = &object->dlpi_phdr[k];
        if (part->p_type != PT_LOAD || !(part->p_flags & PF_X)) continue;
        moduleBegin = (const char*)object->dlpi_addr + part->p_vaddr;
        moduleEnd = moduleBegin + part->p_memsz;
    }
    return 1;
}

/// Patina's module, and Python, which runs the rest of Patina.
static int isOwn(const void* address) {
    Dl_info found, program;
    if (!dladdr(address, &found)) return 0;
    if (dladdr((void*)getauxval(AT_ENTRY), &program) && found.dli_fbase == program.dli_fbase)
        return 1;
    const char* name = objectOf(address);
    return strncmp(name, "_patina", 7) == 0 || strncmp(name, "libpython", 9) == 0;
}

/// The C and C++ libraries, and this one: whoever calls them is meant.
static int isSystem(const void* address) {
    static const char* const names[] = {"libc.so",     "libc-",     "libstdc++", "libgcc_s",
                                        "libpthread.", "ld-linux-", "libm.so"};
    const char* name = objectOf(address);
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (strncmp(name, names[k], strlen(names[k])) == 0) return 1;
    return strcmp(name, objectOf((void*)isSystem)) == 0;
}

/// @returns the number of the innermost frame that Patina or Python holds; the depth without one
static int ownFrame(void** stack, int depth) {
    int k = 0;
    while (k < depth && !isOwn(stack[k]))
        k++;
    return k;
}

/// @returns the name of the library that called, or died; empty where it is no other library
static const char* libraryOf(void** stack, int depth) {
    int k = 0;
    while (k < depth && isSystem(stack[k]))
        k++;
    return k < depth && !isOwn(stack[k]) ? objectOf(stack[k]) : "";
}

/// Whether an exception that nobody catches ends the process: it may have passed through Patina.
static int endsByException(void** stack, int depth) {
    for (int k = 0; k < depth; k++) {
        Dl_info found;
        if (dladdr(stack[k], &found) && found.dli_sname &&
            strcmp(found.dli_sname, "_ZSt9terminatev") == 0)
            return 1;
    }
    return 0;
}

static int diesInTheCallThatFailed(void** died, int depth) {
    int a = ownFrame(asked, askedDepth), d = ownFrame(died, depth);
    // Threads of a library's own, without a frame of Patina: one library made the call and died.
    if (a == askedDepth && d == depth)
        return strcmp(libraryOf(asked, askedDepth), libraryOf(died, depth)) == 0;
    if (askedDepth - a != depth - d || endsByException(died, depth)) return 0;
    // All calls of Python come from one place. One library then leaves its own objects half made.
    if (strncmp(objectOf(asked[a]), "_patina", 7) != 0 &&
        strcmp(libraryOf(asked, askedDepth), libraryOf(died, depth)) != 0)
        return 0;
    return memcmp(asked + a, died + d, (size_t)(depth - d) * sizeof *died) == 0;
}

static void onDeath(int number) {
    static volatile sig_atomic_t entered;
    if (!entered++) {
        void* died[deepest];
        int depth = backtrace(died, deepest);
        char text[512];
        const char *by = libraryOf(asked, askedDepth), *in = libraryOf(died, depth);
        int size = snprintf(text, sizeof text, "died after %s failed, called by %s, in %s%s\n",
                            failed, *by ? by : "Patina", *in ? in : "Patina",
                            failed[0] && *by && *in && diesInTheCallThatFailed(died, depth)
                                ? ": a library died in the call that failed"
                                : "");
        if (write(STDERR_FILENO, text, (size_t)size) < 0) size = 0;
    }
    sigaction(number, &handlersBefore[number], NULL);
    if (number == SIGABRT) raise(number); // the others come again where they came from
}

static void watchForDeath(void) {
    static int watched;
    void* some[2];
    backtrace(some, 2); // loads what it needs, before a call fails
    askedDepth = 0;
    dl_iterate_phdr(findModule, NULL);
    if (watched++) return;
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = onDeath;
    action.sa_flags = SA_ONSTACK | SA_NODEFER;
    static const int numbers[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        sigaction(numbers[k], &action, &handlersBefore[numbers[k]]);
}

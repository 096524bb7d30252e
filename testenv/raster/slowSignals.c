/* SPDX-License-Identifier: Apache-2.0
 * To be preloaded: llvmpipe's threads wait after they have signalled a fence, before they unlock its mutex. Counts the
 * signals, and the fences that are freed in the meantime, and writes both to the file PATINA_SLOW_SIGNALS when the
 * process ends. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <malloc.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { THREADS = 64, MICROSECONDS = 200 };

static _Atomic(char*) signalled[THREADS]; /* conditions, by the number of the thread */
static atomic_long signals, freed;

int pthread_cond_broadcast(pthread_cond_t* condition) {
    static int (*broadcast)(pthread_cond_t*);
    if (!broadcast) broadcast = (int (*)(pthread_cond_t*))dlvsym(RTLD_NEXT, "pthread_cond_broadcast", "GLIBC_2.3.2");
    if (!broadcast) broadcast = (int (*)(pthread_cond_t*))dlsym(RTLD_NEXT, "pthread_cond_broadcast");
    const int result = broadcast(condition);
    char name[16] = "";
    prctl(PR_GET_NAME, name);
    if (strncmp(name, "llvmpipe-", 9)) return result;
    _Atomic(char*)* mine = &signalled[atoi(name + 9) % THREADS];
    atomic_fetch_add(&signals, 1);
    atomic_store(mine, (char*)condition);
    usleep(MICROSECONDS);
    atomic_store(mine, NULL);
    return result;
}

void free(void* piece) {
    static void (*next)(void*);
    if (!next) next = (void (*)(void*))dlsym(RTLD_NEXT, "free");
    for (int i = 0; piece && i < THREADS; ++i) {
        const char* condition = atomic_load_explicit(&signalled[i], memory_order_relaxed);
        /* Of the fence, the condition comes after the mutex. */
        if (condition && (char*)piece <= condition && condition < (char*)piece + malloc_usable_size(piece))
            atomic_fetch_add(&freed, 1);
    }
    next(piece);
}

__attribute__((destructor)) static void write_counts(void) {
    const char* path = getenv("PATINA_SLOW_SIGNALS");
    FILE* file = path ? fopen(path, "w") : NULL;
    if (!file) return;
    fprintf(file, "%ld %ld\n", signals, freed);
    fclose(file);
}

/* Commands end without destructors. */
void _exit(int status) {
    write_counts();
    syscall(SYS_exit_group, status);
    __builtin_unreachable();
}

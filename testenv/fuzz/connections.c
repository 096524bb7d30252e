// SPDX-License-Identifier: Apache-2.0
// Preloaded: whoever looks for another machine, or calls one, dies. test_connections.py builds it.
#define _GNU_SOURCE
#include <netdb.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

static void refuse(void) {
    static const char text[] = "a connection was tried\n";
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) _exit(1);
    abort();
}

static int isRemote(const struct sockaddr* address) {
    return address && (address->sa_family == AF_INET || address->sa_family == AF_INET6);
}

int socket(int family, int kind, int protocol) {
    if (family == AF_INET || family == AF_INET6) refuse();
    return (int)syscall(SYS_socket, family, kind, protocol);
}

int connect(int file, const struct sockaddr* address, socklen_t size) {
    if (isRemote(address)) refuse();
    return (int)syscall(SYS_connect, file, address, size);
}

int getaddrinfo(const char* host, const char* service, const struct addrinfo* hints,
                struct addrinfo** found) {
    (void)host, (void)service, (void)hints, (void)found;
    refuse();
    return EAI_FAIL;
}

// SPDX-License-Identifier: Apache-2.0
// The entry that libFuzzer calls; PATINA_FUZZER is one of the functions of targets.h.
#include "testenv/fuzz/targets/targets.h"

#include <atomic>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    (void)PATINA_FUZZER(data, size);
    return 0;
}

// To read an image of any size OpenImageIO makes room for 64 MB several times, and
// AddressSanitizer would write marks for each byte of it: that took nine tenths of an input's time.
namespace {

constexpr size_t large = size_t(1) << 25, largest = size_t(1) << 30;

struct Room {
    std::atomic<void*> begin{nullptr};
    size_t size = 0;
};
Room rooms[256]; // those that are in use begin somewhere

} // namespace

void* operator new[](size_t size) {
    if (size >= large && size <= largest)
        for (Room& room : rooms) {
            void* none = nullptr;
            if (!room.begin.compare_exchange_strong(none, &room)) continue;
            room.size = size;
            room.begin = ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
            if (room.begin != MAP_FAILED) return room.begin;
            room.begin = nullptr;
            break;
        }
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}

void operator delete[](void* p) noexcept {
    if (reinterpret_cast<uintptr_t>(p) % 4096 == 0 && p)
        for (Room& room : rooms)
            if (room.begin == p) {
                const size_t size = room.size;
                room.begin = nullptr;
                ::munmap(p, size);
                return;
            }
    std::free(p);
}

void operator delete[](void* p, size_t) noexcept {
    operator delete[](p);
}

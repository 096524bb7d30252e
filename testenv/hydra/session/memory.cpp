// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/session/memory.h"

#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace patina {

namespace {

/// @param name a line of /proc/self/status that is in kB
double statusBytes(const std::string& name) {
    std::ifstream in("/proc/self/status");
    std::string line;
    while (std::getline(in, line))
        if (line.compare(0, name.size(), name) == 0)
            return 1024.0 * std::stod(line.substr(name.size()));
    return 0.0;
}

} // namespace

MemoryUse memoryUse() {
    MemoryUse use;
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    malloc_trim(0);
    const struct mallinfo2 found = mallinfo2(); // sums all arenas
    use.heap = double(found.uordblks) + double(found.hblkhd);
#endif
    use.resident = statusBytes("RssAnon:") + statusBytes("RssShmem:");
    return use;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace patina {

/// Bytes of this process.
struct MemoryUse {
    double heap = 0.0;     ///< that malloc has handed out and not got back, in all arenas
    double resident = 0.0; ///< of no file: heap, stacks, mappings of drivers and of Embree
};

/// Gives back what malloc can give back, then counts. Needs Linux and glibc; zeros elsewhere.
MemoryUse memoryUse();

} // namespace patina

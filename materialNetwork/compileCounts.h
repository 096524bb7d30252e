// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace patina {

/// Counts of the work on materials since the process began; tests check that it is done once.
struct CompileCounts {
    std::atomic<long> expansions{0}; ///< networks expanded into graphs
    std::atomic<long> irs{0};        ///< plans compiled
    std::atomic<long> programs{0};   ///< IRs with their methods, made ready for the processor
};

inline CompileCounts& compileCounts() {
    static CompileCounts counts;
    return counts;
}

} // namespace patina

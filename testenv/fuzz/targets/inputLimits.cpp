// SPDX-License-Identifier: Apache-2.0
#include "testenv/fuzz/targets/inputLimits.h"

#include "base/limits.h"

#include <cstdlib>

namespace patina {

void limitInputs() {
    static const std::string refused = setLimits({{"textureBytes", uint64_t(1) << 16},
                                                  {"documentBytes", uint64_t(1) << 16},
                                                  {"includes", 40},
                                                  {"includeDepth", 8}});
    if (!refused.empty()) std::abort();
}

} // namespace patina

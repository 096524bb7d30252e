// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/support.h"

namespace patina {

bool isSupported(std::string* reason) {
#if defined(__AVX2__) && (defined(__GNUC__) || defined(__clang__))
    // Code compiled for a newer processor would end the host with an illegal instruction.
    if (!__builtin_cpu_supports("avx2")) {
        if (reason)
            *reason = "this processor has no AVX2, which the plugin was compiled for; build it "
                      "with PATINA_NATIVE=OFF";
        return false;
    }
#endif
#if defined(__AVX512F__) && (defined(__GNUC__) || defined(__clang__))
    if (!__builtin_cpu_supports("avx512f")) {
        if (reason)
            *reason = "this processor has no AVX-512, which the plugin was compiled for; build it "
                      "with PATINA_NATIVE=OFF";
        return false;
    }
#endif
    if (reason) reason->clear();
    return true;
}

} // namespace patina

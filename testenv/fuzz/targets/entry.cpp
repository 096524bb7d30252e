// SPDX-License-Identifier: Apache-2.0
// The entry that libFuzzer calls; PATINA_FUZZER is one of the functions of targets.h.
#include "testenv/fuzz/targets/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return PATINA_FUZZER(data, size);
}

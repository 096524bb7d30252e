// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/ir/materialIr.h"
#include "materialNetwork/ir/registerFile.h"

#include <vector>

namespace patina {

static_assert(Bsdf::maxLobes == MaterialIr::maxLobes && Bsdf::maxFrames == MaterialIr::maxFrames,
              "a Bsdf has room for what a program has");

/// The IR of a material with its methods, and what the processor makes of it once.
struct ProgramCode : MaterialIr {
    /// Per lobe: set up already where it is constant; kind, diffuse and frame always.
    std::vector<BsdfLobe> prebuilt;

    explicit ProgramCode(MaterialIr ir);
};

} // namespace patina

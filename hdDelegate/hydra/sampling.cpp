// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/sampling.h"

namespace patina {

void warnOfSamples(HdPatinaRenderParam& param, const SdfPath& id, const std::string& input,
                   size_t count) {
    param.warn(id, input,
               "has " + std::to_string(count) + " time samples in the shutter; " +
                   std::to_string(maxTimeSamples) + " of them are used");
}

} // namespace patina

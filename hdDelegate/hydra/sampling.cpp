// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/sampling.h"

#include <cmath>

namespace patina {

void warnOfSamples(HdPatinaRenderParam& param, const SdfPath& id, const std::string& input,
                   size_t count) {
    param.warn(id, input, messages::timeSamplesTooMany(count, maxTimeSamples));
}

MotionTransform transformOf(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                            const SdfPath& id, const GfMatrix4d& before) {
    MatrixSamples samples;
    sampleTransform(delegate, param, id, samples);
    std::vector<float> times;
    std::vector<dmat4> values;
    for (size_t i = 0; i < samples.count; ++i) {
        const dmat4 m = toMat4(before * samples.values[i]);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                if (!std::isfinite(float(m[c][r]))) {
                    param.warn(id, "transform", messages::transformNotFinite);
                    return mat4(1.0f);
                }
        times.push_back(samples.times[i]);
        values.push_back(m);
    }
    if (values.empty()) return toMat4(before);
    addNow(param, times, values, [&] { return toMat4(before * delegate.GetTransform(id)); });
    goOn(param, times, values);
    return inOrder(std::move(times), std::move(values), param, id, "transform");
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/pointSteps.h"

#include "hdDelegate/scene/instancerCheck.h"
#include "hdDelegate/scene/motionSteps.h"

namespace patina {

namespace {

/// The samples that can be used together.
struct UsableSamples {
    std::vector<float> times;
    std::vector<const std::vector<vec3>*> values;
};

UsableSamples usableSamples(const Sampled<std::vector<vec3>>& points, const std::string& prim,
                            Diagnostics& diagnostics) {
    UsableSamples result;
    bool timesFit = points.times.size() == points.values.size();
    for (size_t i = 1; timesFit && i < points.times.size(); ++i)
        timesFit = points.times[i] > points.times[i - 1];
    if (!timesFit && points.values.size() > 1) {
        diagnostics.warn(prim, "points", messages::samplesNotAscending);
        result.times = {0.0f};
        result.values = {&points.values.front()};
        return result;
    }
    size_t nearest = 0;
    for (size_t i = 1; i < points.times.size(); ++i)
        if (std::abs(points.times[i]) < std::abs(points.times[nearest])) nearest = i;
    for (size_t i = 0; i < points.values.size(); ++i) {
        if (points.values[i].size() != points.values[nearest].size()) continue;
        result.times.push_back(points.times.empty() ? 0.0f : points.times[i]);
        result.values.push_back(&points.values[i]);
    }
    if (result.values.size() != points.values.size())
        diagnostics.warn(prim, "points", messages::pointCountChanges);
    return result;
}

/// Whether rays can follow to a point: it is a number, and not too far away.
bool usable(const vec3& p) {
    constexpr float largest = float(largestPlace);
    return std::abs(p.x) <= largest && std::abs(p.y) <= largest && std::abs(p.z) <= largest;
}

} // namespace

PointSteps resamplePoints(const Sampled<std::vector<vec3>>& points, const std::string& prim,
                          const TessellationOptions& options, Diagnostics& diagnostics) {
    PointSteps result;
    if (points.empty()) {
        result.steps.resize(1);
        return result;
    }
    const UsableSamples samples = usableSamples(points, prim, diagnostics);
    std::vector<float> times =
        motionTimes(samples.times, options.shutterOpen, options.shutterClose);
    if (options.withMoments && points.moves()) times.insert(times.end(), {-1.0f, 0.0f, 1.0f});
    result.steps.resize(times.size());
    for (size_t step = 0; step < times.size(); ++step) {
        const SampleSpan span = sampleSpan(samples.times, times[step]);
        std::vector<vec3>& out = result.steps[step];
        const std::vector<vec3>& a = *samples.values[span.index];
        // Embree reads 16 bytes of the last point.
        out.reserve(a.size() + 1);
        out = a;
        if (span.fraction > 0.0f) {
            const std::vector<vec3>& b = *samples.values[span.index + 1];
            for (size_t i = 0; i < out.size(); ++i)
                out[i] = a[i] * (1.0f - span.fraction) + b[i] * span.fraction;
        }
    }
    for (const auto& step : result.steps)
        for (size_t i = 0; i < step.size(); ++i)
            if (!usable(step[i])) {
                result.bad.resize(step.size());
                result.bad[i] = 1;
            }
    for (size_t i = 0; i < result.bad.size(); ++i)
        if (result.bad[i])
            for (auto& step : result.steps)
                step[i] = vec3(0.0f);
    return result;
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/hydra/values.h"

#include <pxr/base/gf/math.h>
#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/timeSampleArray.h>

#include <algorithm>
#include <string>
#include <vector>

namespace patina {

/// As many samples over the shutter as the scene takes. Of instances each sample is a matrix more
/// for each of them.
constexpr unsigned int maxTimeSamples = 32;
using MatrixSamples = HdTimeSampleArray<GfMatrix4d, maxTimeSamples>;
using ValueSamples = HdTimeSampleArray<VtValue, maxTimeSamples>;

/// Which of so many samples is kept as the one of a number below maxTimeSamples: evenly spaced
/// ones, the first and the last among them.
inline size_t keptSample(size_t number, size_t count) {
    return number * (count - 1) / (maxTimeSamples - 1);
}

/// Warns that not all of so many samples are kept.
void warnOfSamples(HdPatinaRenderParam& param, const SdfPath& id, const std::string& input,
                   size_t count);

/// Hosts give all samples that are authored, however many.
template <class Samples> void limitSamples(HdPatinaRenderParam& param, const SdfPath& id,
                                           const std::string& input, Samples& samples) {
    const size_t count = samples.count;
    if (count <= maxTimeSamples) return;
    for (size_t i = 1; i < maxTimeSamples; ++i) {
        const size_t kept = keptSample(i, count); // at or behind i: what is read is still there
        samples.times[i] = samples.times[kept];
        samples.values[i] = samples.values[kept];
    }
    samples.Resize(maxTimeSamples);
    warnOfSamples(param, id, input, count);
}

/// \return whether no camera opens a shutter. Then nothing is sampled: it would be time lost, and
/// UsdImaging never returns from it on stages of 0 time codes per second.
inline bool isStill(const HdPatinaRenderParam& param) {
    return param.shutter() == GfVec2f(0.0f);
}

inline void takeOne(MatrixSamples& samples, const GfMatrix4d& value) {
    samples.Resize(1);
    samples.times[0] = 0.0f;
    samples.values[0] = value;
}

// Samples over the shutter. Newer releases have to be told when that is open: left to themselves
// scene indices give one sample.

inline void sampleTransform(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                            const SdfPath& id, MatrixSamples& samples) {
    if (isStill(param)) return takeOne(samples, delegate.GetTransform(id));
#if PATINA_HAS_SAMPLE_INTERVAL
    const GfVec2f shutter = param.shutter();
    delegate.SampleTransform(id, shutter[0], shutter[1], &samples);
#else
    delegate.SampleTransform(id, &samples);
#endif
    limitSamples(param, id, "transform", samples);
}

inline void sampleInstancerTransform(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                     const SdfPath& id, MatrixSamples& samples) {
    if (isStill(param)) return takeOne(samples, delegate.GetInstancerTransform(id));
#if PATINA_HAS_SAMPLE_INTERVAL
    const GfVec2f shutter = param.shutter();
    delegate.SampleInstancerTransform(id, shutter[0], shutter[1], &samples);
#else
    delegate.SampleInstancerTransform(id, &samples);
#endif
    limitSamples(param, id, "transform", samples);
}

inline void samplePrimvar(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                          const TfToken& name, ValueSamples& samples) {
#if PATINA_HAS_SAMPLE_INTERVAL
    const GfVec2f shutter = param.shutter();
    delegate.SamplePrimvar(id, name, shutter[0], shutter[1], &samples);
#else
    delegate.SamplePrimvar(id, name, &samples);
#endif
    limitSamples(param, id, name.GetString(), samples);
}

/// A value between two, or beyond them in a straight line.
template <class T> T between(const T& a, const T& b, double share) {
    return a * (1.0 - share) + b * share;
}
inline vec3 between(const vec3& a, const vec3& b, double share) {
    return a * float(1.0 - share) + b * float(share);
}
template <class T>
std::vector<T> between(const std::vector<T>& a, const std::vector<T>& b, double share) {
    if (a.size() != b.size()) return b;
    std::vector<T> result;
    result.reserve(a.size());
    for (size_t i = 0; i < a.size(); ++i)
        result.push_back(between(a[i], b[i], share));
    return result;
}

/// For AOVs of motion: samples that end where the camera's shutter does go on in a straight line to
/// the frames beside. UsdImagingDelegate has no others, whatever it is asked for.
template <class T>
void goOn(HdPatinaRenderParam& param, std::vector<float>& times, std::vector<T>& values) {
    const GfVec2f own = param.cameraShutter();
    const size_t n = times.size();
    if (!param.tellsMotion() || !(own[1] > own[0]) || n < 2 || !(times[n - 1] > times[n - 2]) ||
        !(times[1] > times[0]))
        return;
    const auto shareAt = [&](size_t i, float time) {
        return double(time - times[i]) / double(times[i + 1] - times[i]);
    };
    if (GfIsClose(times.back(), own[1], 1e-5) && own[1] < 1.0f) {
        values.push_back(between(values[n - 2], values[n - 1], shareAt(n - 2, 1.0f)));
        times.push_back(1.0f);
    }
    if (GfIsClose(times.front(), own[0], 1e-5) && own[0] > -1.0f) {
        values.insert(values.begin(), between(values[0], values[1], shareAt(0, -1.0f)));
        times.insert(times.begin(), -1.0f);
    }
}

/// For AOVs of motion: samples may be far apart, and turns are not linear between them; the picture
/// is of the frame's own.
template <class T, class F> void addNow(HdPatinaRenderParam& param, std::vector<float>& times,
                                        std::vector<T>& values, const F& now) {
    const auto next = std::lower_bound(times.begin(), times.end(), 0.0f);
    if (!param.tellsMotion() || values.size() < 2 || (next != times.end() && *next == 0.0f)) return;
    values.insert(values.begin() + (next - times.begin()), now());
    times.insert(next, 0.0f);
}

/// sampledOf(), with a warning where the times of a host are out of order.
template <class T> Sampled<T> inOrder(std::vector<float> times, std::vector<T> values,
                                      HdPatinaRenderParam& param, const SdfPath& id,
                                      const char* input) {
    bool mistaken = false;
    Sampled<T> result = sampledOf(std::move(times), std::move(values), &mistaken);
    if (mistaken) param.warn(id, input, messages::samplesNotAscending);
    return result;
}

/// The transform of a prim over the shutter; none, after a warning, where it is not finite.
/// @param before  stands before it
MotionTransform transformOf(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                            const SdfPath& id, const GfMatrix4d& before = GfMatrix4d(1.0));

} // namespace patina

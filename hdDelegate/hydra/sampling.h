// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/hydra/renderParam.h"

#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/timeSampleArray.h>

namespace patina {

constexpr unsigned int maxTimeSamples = 32;
using MatrixSamples = HdTimeSampleArray<GfMatrix4d, maxTimeSamples>;
using ValueSamples = HdTimeSampleArray<VtValue, maxTimeSamples>;

// Samples over the shutter. Newer releases have to be told when that is open: left to themselves
// scene indices give one sample.

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

#if PATINA_HAS_SAMPLE_INTERVAL
inline void sampleTransform(HdSceneDelegate& delegate, const HdPatinaRenderParam& param,
                            const SdfPath& id, MatrixSamples& samples) {
    if (isStill(param)) return takeOne(samples, delegate.GetTransform(id));
    const GfVec2f shutter = param.shutter();
    delegate.SampleTransform(id, shutter[0], shutter[1], &samples);
}
inline void sampleInstancerTransform(HdSceneDelegate& delegate, const HdPatinaRenderParam& param,
                                     const SdfPath& id, MatrixSamples& samples) {
    if (isStill(param)) return takeOne(samples, delegate.GetInstancerTransform(id));
    const GfVec2f shutter = param.shutter();
    delegate.SampleInstancerTransform(id, shutter[0], shutter[1], &samples);
}
inline void samplePrimvar(HdSceneDelegate& delegate, const HdPatinaRenderParam& param,
                          const SdfPath& id, const TfToken& name, ValueSamples& samples) {
    const GfVec2f shutter = param.shutter();
    delegate.SamplePrimvar(id, name, shutter[0], shutter[1], &samples);
}
#else
inline void sampleTransform(HdSceneDelegate& delegate, const HdPatinaRenderParam& param,
                            const SdfPath& id, MatrixSamples& samples) {
    if (isStill(param)) return takeOne(samples, delegate.GetTransform(id));
    delegate.SampleTransform(id, &samples);
}
inline void sampleInstancerTransform(HdSceneDelegate& delegate, const HdPatinaRenderParam& param,
                                     const SdfPath& id, MatrixSamples& samples) {
    if (isStill(param)) return takeOne(samples, delegate.GetInstancerTransform(id));
    delegate.SampleInstancerTransform(id, &samples);
}
inline void samplePrimvar(HdSceneDelegate& delegate, const HdPatinaRenderParam&, const SdfPath& id,
                          const TfToken& name, ValueSamples& samples) {
    delegate.SamplePrimvar(id, name, &samples);
}
#endif

} // namespace patina

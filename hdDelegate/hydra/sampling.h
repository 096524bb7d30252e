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

#if PATINA_HAS_SAMPLE_INTERVAL
inline void sampleTransform(HdSceneDelegate& delegate, const HdPatinaRenderParam& param,
                            const SdfPath& id, MatrixSamples& samples) {
    const GfVec2f shutter = param.shutter();
    delegate.SampleTransform(id, shutter[0], shutter[1], &samples);
}
inline void sampleInstancerTransform(HdSceneDelegate& delegate, const HdPatinaRenderParam& param,
                                     const SdfPath& id, MatrixSamples& samples) {
    const GfVec2f shutter = param.shutter();
    delegate.SampleInstancerTransform(id, shutter[0], shutter[1], &samples);
}
inline void samplePrimvar(HdSceneDelegate& delegate, const HdPatinaRenderParam& param,
                          const SdfPath& id, const TfToken& name, ValueSamples& samples) {
    const GfVec2f shutter = param.shutter();
    delegate.SamplePrimvar(id, name, shutter[0], shutter[1], &samples);
}
#else
inline void sampleTransform(HdSceneDelegate& delegate, const HdPatinaRenderParam&,
                            const SdfPath& id, MatrixSamples& samples) {
    delegate.SampleTransform(id, &samples);
}
inline void sampleInstancerTransform(HdSceneDelegate& delegate, const HdPatinaRenderParam&,
                                     const SdfPath& id, MatrixSamples& samples) {
    delegate.SampleInstancerTransform(id, &samples);
}
inline void samplePrimvar(HdSceneDelegate& delegate, const HdPatinaRenderParam&, const SdfPath& id,
                          const TfToken& name, ValueSamples& samples) {
    delegate.SamplePrimvar(id, name, &samples);
}
#endif

} // namespace patina

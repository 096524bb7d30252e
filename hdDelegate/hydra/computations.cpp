// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/computations.h"

namespace patina {

namespace {

/// Answers for a host while computations are run. Scene indices up to OpenUSD 25.08 count no sample
/// of an input that does not vary, and the computation would miss it.
class InputsOfHost final : public HdSceneDelegate {
public:
    InputsOfHost(HdSceneDelegate& host, bool isStill)
        : HdSceneDelegate(&host.GetRenderIndex(), host.GetDelegateID()), _host(host),
          _isStill(isStill) {}

    VtValue GetExtComputationInput(const SdfPath& id, const TfToken& input) override {
        return _host.GetExtComputationInput(id, input);
    }
    void InvokeExtComputation(const SdfPath& id, HdExtComputationContext* context) override {
        _host.InvokeExtComputation(id, context);
    }
#if PATINA_HAS_COMPUTED_INTERVAL
    size_t SampleExtComputationInput(const SdfPath& id, const TfToken& input, float start,
                                     float end, size_t most, float* times,
                                     VtValue* values) override {
        const size_t count =
            _isStill ? 0
                     : _host.SampleExtComputationInput(id, input, start, end, most, times, values);
        return count > 0 ? count : takeUnsampled(id, input, start, times, values);
    }
#endif
    size_t SampleExtComputationInput(const SdfPath& id, const TfToken& input, size_t most,
                                     float* times, VtValue* values) override {
        const size_t count =
            _isStill ? 0 : _host.SampleExtComputationInput(id, input, most, times, values);
        return count > 0 ? count : takeUnsampled(id, input, 0.0f, times, values);
    }

private:
    size_t takeUnsampled(const SdfPath& id, const TfToken& input, float time, float* times,
                         VtValue* values) {
        times[0] = time;
        values[0] = _host.GetExtComputationInput(id, input);
        return values[0].IsEmpty() ? 0 : 1;
    }

    HdSceneDelegate& _host;
    bool _isStill;
};

} // namespace

ComputedValues computedValues(const HdExtComputationPrimvarDescriptorVector& primvars,
                              HdSceneDelegate& delegate, const HdPatinaRenderParam& param) {
    InputsOfHost inputs(delegate, isStill(param));
    ComputedValues values;
#if PATINA_HAS_COMPUTED_INTERVAL
    const GfVec2f shutter = param.shutter();
    HdExtComputationUtils::SampleComputedPrimvarValues<maxTimeSamples>(
        primvars, &inputs, shutter[0], shutter[1], maxTimeSamples, &values);
#else
    HdExtComputationUtils::SampleComputedPrimvarValues<maxTimeSamples>(primvars, &inputs,
                                                                       maxTimeSamples, &values);
#endif
    return values;
}

} // namespace patina

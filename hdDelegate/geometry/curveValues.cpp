// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/curveValues.h"

#include <algorithm>

namespace patina {

bool CurveValues::read(const Primvar& primvar, const CurveBatch& batch, const std::string& prim,
                       Diagnostics& diagnostics) {
    _interpolation = primvar.interpolation;
    _components = primvar.components;
    ElementCounts counts = batch.counts;
    const size_t stored = primvar.values.size() / size_t(std::max(primvar.components, 1));
    const size_t elements = primvar.indices.empty() ? stored : primvar.indices.size();
    // On curves there is no difference between varying and faceVarying.
    if (_interpolation == Interpolation::FaceVarying) _interpolation = Interpolation::Varying;
    if (elements == 1) _interpolation = Interpolation::Constant;
    if (_interpolation == Interpolation::Varying && elements != counts.varying &&
        elements == batch.shortVarying) {
        _short = true;
        counts.varying = counts.faceVarying = batch.shortVarying;
    }
    return expandPrimvar(primvar, counts, prim, diagnostics, _data);
}

void CurveValues::setConstant(std::vector<float> value) {
    _interpolation = Interpolation::Constant;
    _components = int(value.size());
    _data = std::move(value);
}

void CurveValues::atPoint(const CurveBatch& batch, size_t curve, int k, float* out) const {
    const CurveLayout::Point point = batch.layouts[curve].points[k];
    const auto element = [&](int local) {
        const size_t index = _interpolation == Interpolation::Constant ? 0
                             : _interpolation == Interpolation::Uniform
                                 ? curve
                                 : batch.firstPoint[curve] + size_t(local);
        return &_data[index * _components];
    };
    const float* a = element(point.a);
    const float* b = point.phantom() ? element(point.b) : a;
    for (int i = 0; i < _components; ++i)
        out[i] = 2.0f * a[i] - b[i];
}

void CurveValues::atSegmentEnd(const CurveBatch& batch, size_t curve, int segment, int end,
                               float* out) const {
    const CurveLayout& layout = batch.layouts[curve];
    if (isVarying()) {
        int index = segment + end;
        size_t first = batch.firstVarying[curve];
        if (_short) {
            index = std::clamp(index - 1, 0, std::max(layout.segments - 2, 0));
            first = batch.firstShortVarying[curve];
        } else if (batch.wrap == CurveWrap::Periodic) {
            index %= varyingCount(layout, batch.wrap);
        }
        std::copy_n(&_data[(first + size_t(index)) * _components], _components, out);
        return;
    }
    const int points = batch.basis == CurveBasis::Linear ? 2 : 4;
    const vec4 weights = basisWeights(batch.basis, float(end));
    float value[16];
    std::fill_n(out, _components, 0.0f);
    for (int k = 0; k < points; ++k) {
        atPoint(batch, curve, segment * layout.step + k, value);
        for (int i = 0; i < _components; ++i)
            out[i] += weights[k] * value[i];
    }
}

void CurveValues::asBezier(const CurveBatch& batch, size_t curve, int segment, float* out) const {
    const CurveBasis basis = isVarying() ? CurveBasis::Linear : batch.basis;
    float in[4][16] = {};
    if (isVarying())
        for (int end = 0; end < 2; ++end)
            atSegmentEnd(batch, curve, segment, end, in[end]);
    else
        for (int k = 0; k < (basis == CurveBasis::Linear ? 2 : 4); ++k)
            atPoint(batch, curve, segment * batch.layouts[curve].step + k, in[k]);
    for (int i = 0; i < _components; ++i) {
        const float p[4] = {in[0][i], in[1][i], in[2][i], in[3][i]};
        float bezier[4] = {};
        toBezier(basis, p, bezier);
        for (int k = 0; k < 4; ++k)
            out[k * _components + i] = bezier[k];
    }
}

} // namespace patina

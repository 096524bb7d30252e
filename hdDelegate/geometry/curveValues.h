// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/curveSegments.h"
#include "hdDelegate/geometry/primvarExpand.h"

namespace patina {

/// The curves of a prim taken apart, with where the values of each begin.
struct CurveBatch {
    std::vector<CurveLayout> layouts;
    std::vector<size_t> firstPoint, firstVarying, firstShortVarying;
    CurveBasis basis = CurveBasis::Linear;
    CurveWrap wrap = CurveWrap::Nonperiodic;
    ElementCounts counts;
    /// Varying values of pinned curves may leave out the segments that phantom points add:
    /// OpenUSD's schema and its code disagree, and both are accepted.
    size_t shortVarying = 0;
};

/// A primvar of curves: its value at control points and at ends of segments.
class CurveValues {
public:
    /// @returns false, after a warning, when the primvar does not fit
    bool read(const Primvar& primvar, const CurveBatch& batch, const std::string& prim,
              Diagnostics& diagnostics);
    void setConstant(std::vector<float> value);

    int components() const { return _components; }
    Interpolation interpolation() const { return _interpolation; }
    /// Whether values stand on the ends of segments of cubic curves, not on control points.
    bool isVarying() const { return _interpolation == Interpolation::Varying; }
    std::vector<float>& data() { return _data; }

    /// Value at control point k of a curve's layout; not for varying values.
    void atPoint(const CurveBatch& batch, size_t curve, int k, float* out) const;
    /// Value at the start (end = 0) or end (end = 1) of a segment.
    void atSegmentEnd(const CurveBatch& batch, size_t curve, int segment, int end,
                      float* out) const;
    /// Values of the four control points of a segment as Bezier.
    void asBezier(const CurveBatch& batch, size_t curve, int segment, float* out) const;

private:
    Interpolation _interpolation = Interpolation::Constant;
    int _components = 1;
    bool _short = false;
    std::vector<float> _data;
};

} // namespace patina

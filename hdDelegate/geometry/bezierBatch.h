// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/curveForms.h"

namespace patina {

/// Collects Bezier curves that are made from curves of another form.
class BezierBatch {
public:
    explicit BezierBatch(const Curves& from);

    /// Begins the curve that comes from an authored one; those that are never begun are left out.
    void begin(size_t authored) { _authored.push_back(authored); }
    void end(int vertices) { _out->curveVertexCounts.push_back(vertices); }
    Curves& out() { return *_out; }

    /// Takes over a primvar of constant or uniform interpolation.
    /// @param values one per authored curve, or one alone
    void addPlain(const Primvar& primvar, std::vector<float> values);
    void add(const Primvar& primvar, Interpolation interpolation, std::vector<float> values);

    /// @param authored number of curves that there were
    std::shared_ptr<const Curves> finish(size_t authored);

private:
    std::shared_ptr<Curves> _out;
    std::vector<size_t> _authored; ///< curve that each came from
};

} // namespace patina

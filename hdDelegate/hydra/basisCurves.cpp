// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/basisCurves.h"

#include "hdDelegate/hydra/sourceForms.h"

#include <pxr/imaging/hd/basisCurvesTopology.h>

#include <algorithm>

namespace patina {

namespace {

CurveBasis basisOf(const HdBasisCurvesTopology& topology, HdPatinaRenderParam& param,
                   const SdfPath& id) {
    if (topology.GetCurveType() == HdTokens->linear) return CurveBasis::Linear;
    const TfToken basis = topology.GetCurveBasis();
    if (basis == HdTokens->bspline) return CurveBasis::Bspline;
    if (basis == HdTokens->catmullRom) return CurveBasis::CatmullRom;
    if (basis != HdTokens->bezier)
        param.warn(id, "basis", messages::basisUnknown(basis.GetString()));
    return CurveBasis::Bezier;
}

CurveWrap wrapOf(const HdBasisCurvesTopology& topology) {
    if (topology.GetCurveWrap() == HdTokens->periodic) return CurveWrap::Periodic;
    if (topology.GetCurveWrap() == HdTokens->pinned) return CurveWrap::Pinned;
    return CurveWrap::Nonperiodic;
}

/// Lines that hosts draw in place of a model (its box, its axes): each is a pair of points. Their
/// width of 1 is a pixel's to a rasterizer. Here it follows from their size.
std::shared_ptr<const Curves> linesOf(const Curves& curves) {
    auto lines = std::make_shared<Curves>(curves);
    if (curves.points.values.empty() || curves.points.values.front().empty()) return lines;
    const std::vector<vec3>& points = curves.points.values.front();
    vec3 low = points.front(), high = low;
    for (const vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    lines->curveVertexCounts.assign(points.size() / 2, 2);
    auto& primvars = lines->primvars;
    primvars.erase(std::remove_if(primvars.begin(), primvars.end(),
                                  [](const Primvar& p) { return p.name == "widths"; }),
                   primvars.end());
    primvars.push_back(
        {"widths", Interpolation::Constant, 1, {standInWidth * glm::length(high - low)}, {}});
    return lines;
}

} // namespace

void HdPatinaBasisCurves::syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                    HdDirtyBits dirtyBits, bool all, const TfToken&,
                                    Curves& curves) {
    const SdfPath& id = GetId();
    if (all || HdChangeTracker::IsTopologyDirty(dirtyBits, id)) {
        const HdBasisCurvesTopology topology = delegate.GetBasisCurvesTopology(id);
        curves.curveVertexCounts = toVector(topology.GetCurveVertexCounts());
        curves.basis = basisOf(topology, param, id);
        curves.wrap = wrapOf(topology);
        _isLines = topology.GetCurveWrap() == HdTokens->segmented;
        _indices = toVector(topology.GetCurveIndices());
        _isStale = true;
    }
    if (_isStale) expandPoints(param, curves);
    _isStale = false;
}

std::shared_ptr<const Geometry>
HdPatinaBasisCurves::shownAs(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                             const std::shared_ptr<const Curves>& curves) const {
    if (_isLines) return linesOf(*curves);
    if (curves->basis != CurveBasis::Linear) return curves;
    const auto bezier = bezierOf(delegate, GetId(), *curves, param.scene()->diagnostics());
    return bezier ? std::shared_ptr<const Geometry>(bezier) : curves;
}

void HdPatinaBasisCurves::setPoints(Curves&, Sampled<std::vector<vec3>> points) {
    _points = std::move(points);
    _isStale = true; // syncShape() follows
}

void HdPatinaBasisCurves::expandPoints(HdPatinaRenderParam& param, Curves& curves) const {
    curves.points = _points;
    if (_indices.empty()) return;
    bool broken = false;
    for (std::vector<vec3>& sample : curves.points.values) {
        std::vector<vec3> ordered;
        ordered.reserve(_indices.size());
        for (const int index : _indices) {
            const bool isPoint = index >= 0 && size_t(index) < sample.size();
            broken |= !isPoint;
            if (!sample.empty()) ordered.push_back(sample[isPoint ? size_t(index) : 0]);
        }
        sample = std::move(ordered);
    }
    if (broken) param.warn(GetId(), "curveIndices", messages::firstPointUsed);
}

} // namespace patina

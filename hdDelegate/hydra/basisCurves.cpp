// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/basisCurves.h"

#include "hdDelegate/hydra/sourceForms.h"

#include <pxr/imaging/hd/basisCurvesTopology.h>

namespace patina {

namespace {

CurveBasis basisOf(const HdBasisCurvesTopology& topology, HdPatinaRenderParam& param,
                   const SdfPath& id) {
    if (topology.GetCurveType() == HdTokens->linear) return CurveBasis::Linear;
    const TfToken basis = topology.GetCurveBasis();
    if (basis == HdTokens->bspline) return CurveBasis::Bspline;
    if (basis == HdTokens->catmullRom) return CurveBasis::CatmullRom;
    if (basis != HdTokens->bezier)
        param.warn(id, "basis", "'" + basis.GetString() + "' is unknown; bezier is drawn");
    return CurveBasis::Bezier;
}

CurveWrap wrapOf(const HdBasisCurvesTopology& topology) {
    if (topology.GetCurveWrap() == HdTokens->periodic) return CurveWrap::Periodic;
    if (topology.GetCurveWrap() == HdTokens->pinned) return CurveWrap::Pinned;
    return CurveWrap::Nonperiodic;
}

} // namespace

void HdPatinaBasisCurves::syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                    HdDirtyBits dirtyBits, bool all, const TfToken&,
                                    Curves& curves) {
    const SdfPath& id = GetId();
    if (!all && !HdChangeTracker::IsTopologyDirty(dirtyBits, id)) return;
    const HdBasisCurvesTopology topology = delegate.GetBasisCurvesTopology(id);
    curves.curveVertexCounts = toVector(topology.GetCurveVertexCounts());
    curves.basis = basisOf(topology, param, id);
    curves.wrap = wrapOf(topology);
    _indices = toVector(topology.GetCurveIndices());
    expandPoints(curves);
}

std::shared_ptr<const Geometry>
HdPatinaBasisCurves::shownAs(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                             const std::shared_ptr<const Curves>& curves) const {
    if (curves->basis != CurveBasis::Linear) return curves;
    const auto bezier = bezierOf(delegate, GetId(), *curves, param.scene()->diagnostics());
    return bezier ? std::shared_ptr<const Geometry>(bezier) : curves;
}

void HdPatinaBasisCurves::setPoints(Curves& curves, Sampled<std::vector<vec3>> points) {
    _points = std::move(points);
    expandPoints(curves);
}

void HdPatinaBasisCurves::expandPoints(Curves& curves) const {
    curves.points = _points;
    if (_indices.empty()) return;
    for (std::vector<vec3>& sample : curves.points.values) {
        std::vector<vec3> ordered;
        ordered.reserve(_indices.size());
        for (const int index : _indices)
            ordered.push_back(index >= 0 && size_t(index) < sample.size() ? sample[size_t(index)]
                                                                          : vec3(0.0f));
        sample = std::move(ordered);
    }
}

} // namespace patina

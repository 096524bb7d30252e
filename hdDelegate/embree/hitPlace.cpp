// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/hitPlace.h"

#include "hdDelegate/geometry/curveSegments.h"
#include "hdDelegate/scene/lightUnits.h"

namespace patina {

namespace {

/// On the triangle that is hit, at a step of positions.
dvec3 onTriangle(const Hit& hit, const std::vector<vec3>& positions) {
    const uvec3& t = hit.surface->topology().triangles[hit.primitive];
    const double u = hit.u, v = hit.v;
    return dvec3(positions[t.x]) * (1.0 - u - v) + dvec3(positions[t.y]) * u +
           dvec3(positions[t.z]) * v;
}

/// The middle of the curve or point that is hit, at a step.
dvec3 middleOf(const Hit& hit, const std::vector<vec4>& points) {
    if (hit.surface->shape == Surface::Shape::Points) return dvec3(points[hit.primitive]);
    const CurveSet& curves = hit.surface->rest->curves;
    const size_t first = curves.segments[hit.primitive];
    const int count = curves.basis == CurveBasis::Linear ? 2 : 4;
    const vec4 weights = basisWeights(curves.basis, hit.u);
    dvec3 middle(0.0);
    for (int i = 0; i < count; ++i)
        middle += double(weights[i]) * dvec3(points[first + size_t(i)]);
    return middle;
}

} // namespace

/// Of what does not deform all steps say the same, and the first one is no mean of two.
dvec3 HitPlace::inPrim() const {
    const Surface& surface = *_hit.surface;
    if (surface.shared)
        return dvec3(dmat4(surface.groupToObject) *
                     glm::dvec4(onTriangle(_hit, surface.positions().front()), 1.0));
    dmat4 toWorld = exactTransformAt(surface.prim->transform, _frame.shutterOpen);
    if (surface.prim->group.empty()) toWorld[3] -= glm::dvec4(dvec3(surface.worldOrigin), 0.0);
    const dvec3 inGroup = surface.shape == Surface::Shape::Triangles
                              ? onTriangle(_hit, surface.placed.positions.front())
                              : middleOf(_hit, surface.placed.points.front());
    return dvec3(glm::inverse(toWorld) * glm::dvec4(inGroup, 1.0));
}

dvec3 HitPlace::inPrimAt(ScreenMotion::Moment moment) const {
    const PlacedShape& moments = _hit.surface->moments;
    if (!moments.positions.empty()) return onTriangle(_hit, moments.positions[moment]);
    if (!moments.points.empty()) return middleOf(_hit, moments.points[moment]);
    return inPrim();
}

dvec3 HitPlace::inWorld(ScreenMotion::Moment moment) const {
    const dmat4 toWorld =
        ScreenMotion::toWorld(*_hit.surface->prim, _hit.steps, _hit.stepCount, moment);
    return dvec3(toWorld * glm::dvec4(inPrimAt(moment), 1.0));
}

} // namespace patina

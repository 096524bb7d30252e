// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/primCompare.h"

#include <algorithm>
#include <array>

namespace patina {

namespace {

template <class T> bool same(const Sampled<T>& a, const Sampled<T>& b) {
    return a.times == b.times && a.values == b.values;
}

bool same(const Primvar& a, const Primvar& b) {
    return a.name == b.name && a.interpolation == b.interpolation && a.components == b.components &&
           a.values == b.values && a.indices == b.indices;
}

bool same(const GeomSubset& a, const GeomSubset& b) {
    return a.faces == b.faces; // their materials are looked up anew
}

template <class T> bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                              [](const T& x, const T& y) { return same(x, y); });
}

bool same(const NurbsDirection& a, const NurbsDirection& b) {
    return a.vertexCount == b.vertexCount && a.order == b.order && a.knots == b.knots &&
           a.low == b.low && a.high == b.high;
}

bool same(const TrimCurves& a, const TrimCurves& b) {
    return a.counts == b.counts && a.orders == b.orders && a.vertexCounts == b.vertexCounts &&
           a.knots == b.knots && a.ranges == b.ranges && a.points == b.points &&
           a.keepInside == b.keepInside;
}

bool same(const std::shared_ptr<const NurbsPatch>& a, const std::shared_ptr<const NurbsPatch>& b) {
    if (!a || !b || a == b) return a == b;
    return same(a->u, b->u) && same(a->v, b->v) && a->weights == b->weights &&
           same(a->trim, b->trim);
}

bool sameKind(const Mesh& a, const Mesh& b) {
    return same(a.patch, b.patch) && same(a.points, b.points) &&
           a.faceVertexCounts == b.faceVertexCounts && a.faceVertexIndices == b.faceVertexIndices &&
           a.holeIndices == b.holeIndices && a.scheme == b.scheme &&
           a.interpolateBoundary == b.interpolateBoundary &&
           a.faceVaryingLinearInterpolation == b.faceVaryingLinearInterpolation &&
           a.triangleSubdivisionRule == b.triangleSubdivisionRule &&
           a.creaseIndices == b.creaseIndices && a.creaseLengths == b.creaseLengths &&
           a.creaseSharpnesses == b.creaseSharpnesses && a.cornerIndices == b.cornerIndices &&
           a.cornerSharpnesses == b.cornerSharpnesses && a.refineLevel == b.refineLevel;
}

bool sameKind(const Curves& a, const Curves& b) {
    return same(a.points, b.points) && a.curveVertexCounts == b.curveVertexCounts &&
           a.basis == b.basis && a.wrap == b.wrap;
}

bool sameKind(const Implicit& a, const Implicit& b) {
    return a.shape == b.shape && a.axis == b.axis && a.radius == b.radius &&
           a.radiusTop == b.radiusTop && a.height == b.height && a.size == b.size &&
           a.width == b.width && a.length == b.length;
}

template <class T> const T& as(const Geometry& prim) {
    return static_cast<const T&>(prim);
}

} // namespace

bool sameShape(const Geometry& a, const Geometry& b) {
    if (&a == &b) return true;
    if (a.kind != b.kind || a.group != b.group || a.leftHanded != b.leftHanded ||
        !same(a.subsets, b.subsets) || !same(a.primvars, b.primvars))
        return false;
    switch (a.kind) {
    case GeometryKind::Mesh: return sameKind(as<Mesh>(a), as<Mesh>(b));
    case GeometryKind::Curves: return sameKind(as<Curves>(a), as<Curves>(b));
    case GeometryKind::Points: return same(as<Points>(a).points, as<Points>(b).points);
    case GeometryKind::Volume:
    case GeometryKind::Splats: return false;
    case GeometryKind::Implicit: return sameKind(as<Implicit>(a), as<Implicit>(b));
    }
    return false;
}

bool sameTransform(const MotionTransform& a, const MotionTransform& b) {
    return same(a, b);
}

bool sameCamera(const Camera& a, const Camera& b) {
    const auto numbers = [](const Camera& c) {
        return std::array<double, 12>{c.horizontalAperture,
                                      c.verticalAperture,
                                      c.horizontalApertureOffset,
                                      c.verticalApertureOffset,
                                      c.focalLength,
                                      c.fStop,
                                      c.focusDistance,
                                      c.clipNear,
                                      c.clipFar,
                                      c.shutterOpen,
                                      c.shutterClose,
                                      c.exposureScale};
    };
    return same(a.transform, b.transform) && a.orthographic == b.orthographic &&
           numbers(a) == numbers(b) && a.clippingPlanes == b.clippingPlanes && a.lens == b.lens;
}

} // namespace patina

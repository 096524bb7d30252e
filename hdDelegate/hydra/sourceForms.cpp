// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/sourceForms.h"

#include "hdDelegate/geometry/nurbs.h"
#include "hdDelegate/hydra/values.h"

#include <pxr/base/gf/vec2d.h>
#include <pxr/base/gf/vec3d.h>
#include <pxr/base/gf/vec3i.h>
#include <pxr/base/gf/vec4i.h>
#include <pxr/base/tf/token.h>

namespace patina {

VtValue sourceOf(HdSceneDelegate& delegate, const SdfPath& id, const std::string& name) {
    const VtValue handedOn = delegate.Get(id, TfToken(sourcePrefix + name));
    return handedOn.IsEmpty() ? delegate.Get(id, TfToken(name)) : handedOn;
}

namespace {

template <class Vector> std::vector<double> flatDoubles(const VtValue& value) {
    std::vector<double> out;
    for (const Vector& v : value.UncheckedGet<VtArray<Vector>>())
        out.insert(out.end(), v.data(), v.data() + Vector::dimension);
    return out;
}

std::vector<double> doublesOf(const VtValue& value) {
    if (value.IsHolding<VtArray<double>>()) return toVector(value.UncheckedGet<VtArray<double>>());
    if (value.IsHolding<VtArray<GfVec2d>>()) return flatDoubles<GfVec2d>(value);
    if (value.IsHolding<VtArray<GfVec3d>>()) return flatDoubles<GfVec3d>(value);
    int components = 0;
    const std::vector<float> floats = floatsOf(value, components);
    return std::vector<double>(floats.begin(), floats.end());
}

std::vector<int> intsOf(const VtValue& value) {
    return value.IsHolding<VtArray<int>>() ? toVector(value.UncheckedGet<VtArray<int>>())
                                           : std::vector<int>();
}

template <class Vector> std::vector<int> flat(const VtValue& value, int components) {
    std::vector<int> out;
    if (value.IsHolding<VtArray<Vector>>())
        for (const Vector& v : value.UncheckedGet<VtArray<Vector>>())
            for (int k = 0; k < components; ++k)
                out.push_back(v[k]);
    return out;
}

int integerOf(const VtValue& value) {
    return value.IsHolding<int>() ? value.UncheckedGet<int>() : 0;
}

NurbsDirection directionOf(HdSceneDelegate& delegate, const SdfPath& id, const std::string& side) {
    NurbsDirection direction;
    direction.vertexCount = integerOf(sourceOf(delegate, id, side + "VertexCount"));
    direction.order = integerOf(sourceOf(delegate, id, side + "Order"));
    direction.knots = doublesOf(sourceOf(delegate, id, side + "Knots"));
    const VtValue range = sourceOf(delegate, id, side + "Range");
    if (range.IsHolding<GfVec2d>()) {
        direction.low = range.UncheckedGet<GfVec2d>()[0];
        direction.high = range.UncheckedGet<GfVec2d>()[1];
    }
    fillKnots(direction);
    return direction;
}

} // namespace

bool readPatch(HdSceneDelegate& delegate, const SdfPath& id, Mesh& mesh) {
    if (integerOf(sourceOf(delegate, id, "uOrder")) == 0) return false;
    auto patch = std::make_shared<NurbsPatch>();
    patch->u = directionOf(delegate, id, "u");
    patch->v = directionOf(delegate, id, "v");
    patch->weights = doublesOf(sourceOf(delegate, id, "pointWeights"));
    TrimCurves& trim = patch->trim;
    trim.counts = intsOf(sourceOf(delegate, id, "trimCurve:counts"));
    if (!trim.counts.empty()) {
        trim.orders = intsOf(sourceOf(delegate, id, "trimCurve:orders"));
        trim.vertexCounts = intsOf(sourceOf(delegate, id, "trimCurve:vertexCounts"));
        trim.knots = doublesOf(sourceOf(delegate, id, "trimCurve:knots"));
        trim.ranges = doublesOf(sourceOf(delegate, id, "trimCurve:ranges"));
        trim.points = doublesOf(sourceOf(delegate, id, "trimCurve:points"));
        const TfToken sense("ri:attributes:trimcurve:sense");
        trim.keepInside = textOf(delegate.Get(id, sense)) == "outside";
    }
    mesh.patch = std::move(patch);
    return true;
}

bool readTets(HdSceneDelegate& delegate, const SdfPath& id, std::vector<int>& tets,
              std::vector<int>& surface) {
    tets = flat<GfVec4i>(sourceOf(delegate, id, "tetVertexIndices"), 4);
    surface.clear();
    if (!tets.empty())
        surface = flat<GfVec3i>(sourceOf(delegate, id, "surfaceFaceVertexIndices"), 3);
    return !tets.empty();
}

std::shared_ptr<const Curves> bezierOf(HdSceneDelegate& delegate, const SdfPath& id,
                                       const Curves& curves, Diagnostics& diagnostics) {
    const std::vector<int> orders = intsOf(sourceOf(delegate, id, "order"));
    if (!orders.empty() && !curves.primvar("order") && !curves.primvar("knots")) {
        NurbsCurves nurbs;
        static_cast<Curves&>(nurbs) = curves;
        nurbs.orders = orders;
        nurbs.knots = doublesOf(sourceOf(delegate, id, "knots"));
        nurbs.ranges = doublesOf(sourceOf(delegate, id, "ranges"));
        nurbs.weights = doublesOf(sourceOf(delegate, id, "pointWeights"));
        return toBezier(nurbs, diagnostics);
    }
    std::vector<vec3> tangents;
    if (curves.primvar("tangents") || !pointsOf(sourceOf(delegate, id, "tangents"), tangents) ||
        tangents.empty())
        return nullptr;
    HermiteCurves hermite;
    static_cast<Curves&>(hermite) = curves;
    hermite.tangents = tangents;
    const TfToken handedOn(std::string(sourcePrefix) + "tangents"); // by the plugin's adapter
    if (!hermite.primvar("widths") && delegate.Get(id, handedOn).IsEmpty())
        diagnostics.warn(id.GetString(), "widths", messages::hermiteWidths);
    return toBezier(hermite, diagnostics);
}

} // namespace patina

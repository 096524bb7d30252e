// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledShapes.h"

#include "hdDelegate/geometry/displace.h"
#include "hdDelegate/geometry/splitTriangles.h"
#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>

namespace patina {

namespace {

/// Times make no difference to what stands still, edges none to what is drawn as it is.
std::array<double, 8> numbersOf(const ShapeRequest& request) {
    const TessellationOptions& o = request.options;
    const GeometryKind kind = request.prim->kind;
    const bool stands = !deforms(*request.prim);
    const double open = stands ? 0.0 : double(o.shutterOpen);
    const double close = stands ? 0.0 : double(o.shutterClose);
    const double moments = !stands && o.withMoments ? 1.0 : 0.0;
    if (kind == GeometryKind::Curves || kind == GeometryKind::Points) return {open, close, moments};
    return {open,
            close,
            moments,
            double(o.targetEdge),
            kind == GeometryKind::Implicit ? double(o.roundEdge) : 0.0,
            double(o.edgeBudget),
            double(o.maxRefineLevel),
            double(o.triangleBudget)};
}

TriangleMesh makeTriangles(const ShapeRequest& request, Diagnostics& diagnostics) {
    TriangleMesh mesh =
        request.prim->kind == GeometryKind::Implicit
            ? tessellate(static_cast<const Implicit&>(*request.prim), request.options, diagnostics)
            : tessellate(static_cast<const Mesh&>(*request.prim), request.options, diagnostics);
    if (request.displaces() && !mesh.positions.empty()) {
        splitTriangles(mesh, request.options.targetEdge, request.options.triangleBudget);
        displace(mesh, request.displacers, request.toWorld);
    }
    return mesh;
}

} // namespace

bool ShapeRequest::displaces() const {
    return std::any_of(displacers.begin(), displacers.end(),
                       [](const auto& program) { return program != nullptr; });
}

mat4 displacementSpace(const Geometry& prim, float timeCode) {
    return mat4(exactTransformAt(prim.transform, timeCode));
}

PrimShape makeShape(const ShapeRequest& request, Diagnostics& diagnostics) {
    PrimShape shape;
    switch (request.prim->kind) {
    case GeometryKind::Mesh:
    case GeometryKind::Implicit: shape.mesh = makeTriangles(request, diagnostics); break;
    case GeometryKind::Curves:
        shape.curves =
            buildCurves(static_cast<const Curves&>(*request.prim), request.options, diagnostics);
        break;
    case GeometryKind::Points:
        shape.points =
            buildPoints(static_cast<const Points&>(*request.prim), request.options, diagnostics);
        break;
    case GeometryKind::Volume:
    case GeometryKind::Splats: break; // no surface
    }
    return shape;
}

CompiledShapes::Key::Key(const ShapeRequest& request)
    : _prim(request.prim), _numbers(numbersOf(request)), _toWorld(request.toWorld) {
    if (request.displaces())
        _displacers.assign(request.displacers.begin(), request.displacers.end());
}

bool CompiledShapes::Key::isOf(const ShapeRequest& request) const {
    if (!_prim.is(request.prim) || _numbers != numbersOf(request)) return false;
    if (!request.displaces() || _displacers.empty())
        return !request.displaces() && _displacers.empty();
    return _toWorld == request.toWorld &&
           std::equal(_displacers.begin(), _displacers.end(), request.displacers.begin(),
                      request.displacers.end(),
                      [](const auto& known, const auto& displacer) { return known.is(displacer); });
}

std::shared_ptr<const PrimShape> CompiledShapes::shape(const ShapeRequest& request) {
    return _shapes.get(request.prim.get(), request, [&] {
        return std::make_shared<const PrimShape>(makeShape(request, _diagnostics));
    });
}

} // namespace patina

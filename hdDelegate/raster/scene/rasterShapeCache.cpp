// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterShapeCache.h"

#include "hdDelegate/raster/gl/heldFences.h"
#include "hdDelegate/raster/scene/rasterDetail.h"
#include "hdDelegate/raster/scene/rasterShapes.h"
#include "hdDelegate/scene/primCompare.h"

#include <algorithm>

namespace patina {

namespace {

bool displaces(const RasterShapeCache::Request& request) {
    return std::any_of(request.displacers.begin(), request.displacers.end(),
                       [](const auto& program) { return program != nullptr; });
}

/// Whether a shape made for `old` serves `request`.
bool serves(const RasterShapeCache::Request& old, const RasterShapeCache::Request& request) {
    return (old.needsMesh || !request.needsMesh) && old.timeCode == request.timeCode &&
           old.strips == request.strips && old.primvars == request.primvars &&
           old.tangentSets == request.tangentSets && old.displacers == request.displacers &&
           (!displaces(request) || old.toWorld == request.toWorld) &&
           sameShape(*old.prim, *request.prim);
}

/// The key of an entry of the cache: the path of a prim, but for implicit prims all that their
/// shape is made of, so that equal ones share it.
std::string nameOf(const RasterShapeCache::Request& request) {
    const Geometry& prim = *request.prim;
    if (prim.kind != GeometryKind::Implicit || !prim.subsets.empty() || displaces(request) ||
        request.needsMesh)
        return prim.path;
    std::string name = "implicit";
    const auto add = [&](const auto* data, size_t count) {
        name.append(reinterpret_cast<const char*>(&count), sizeof count);
        name.append(reinterpret_cast<const char*>(data), count * sizeof *data);
    };
    const auto text = [&](const std::string& word) { add(word.data(), word.size()); };
    const Implicit& shape = static_cast<const Implicit&>(prim);
    const int kinds[] = {int(shape.shape), shape.axis, int(prim.leftHanded), int(request.strips)};
    const float sizes[] = {shape.radius, shape.radiusTop, shape.height,
                           shape.size,   shape.width,     shape.length};
    add(kinds, std::size(kinds));
    add(sizes, std::size(sizes));
    text(prim.group);
    for (size_t i = 0; i < request.primvars.size(); ++i) {
        text("");
        text(request.tangentSets[i]);
        for (const std::string& primvar : request.primvars[i])
            text(primvar);
    }
    for (const Primvar& primvar : prim.primvars) {
        text(primvar.name);
        const int form[] = {int(primvar.interpolation), primvar.components};
        add(form, std::size(form));
        add(primvar.values.data(), primvar.values.size());
        add(primvar.indices.data(), primvar.indices.size());
    }
    return name;
}

void describe(RasterShape& shape, const TriangleMesh& mesh) {
    shape.boundsMin = mesh.boundsMin;
    shape.boundsMax = mesh.boundsMax;
    shape.flags = mesh.normals.empty() ? RasterShape::faceted : 0;
    shape.triangles = mesh.triangles.size();
}

size_t storageLimit() {
    GLint64 limit = 0;
    gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
    // Larger pieces would gain nothing, and take memory while they are made.
    return std::clamp<size_t>(size_t(std::max<GLint64>(limit, 0)), 1 << 24, 1 << 26);
}

} // namespace

std::shared_ptr<const RasterShape> RasterShapeCache::get(const Request& request) {
    Entry& entry = _entries[{nameOf(request), request.edge, request.timeCode}];
    entry.used = true;
    if (!entry.shape || !serves(entry.request, request)) {
        entry.shape = nullptr; // the old buffers make room for the new ones
        entry.shape = build(request);
        entry.request = request;
    }
    entry.request.prim = request.prim; // comparing the same object is quick
    return entry.shape;
}

void RasterShapeCache::forgetUnused() {
    for (auto it = _entries.begin(); it != _entries.end();) {
        if (it->second.used) {
            it->second.used = false;
            ++it;
        } else {
            it = _entries.erase(it);
        }
    }
}

void RasterShapeCache::forgetReplaced() {
    if (_entries.size() < _forgetAt) return;
    for (auto it = _entries.begin(); it != _entries.end();)
        it = !it->second.shape || it->second.shape.use_count() == 1 ? _entries.erase(it)
                                                                    : std::next(it);
    _forgetAt = std::max<size_t>(64, 2 * _entries.size());
}

size_t RasterShapeCache::bytes() const {
    size_t sum = 0;
    for (const auto& item : _entries) {
        if (!item.second.shape) continue; // it could not be built
        for (const auto* surfaces : {&item.second.shape->surfaces, &item.second.shape->casting})
            for (const RasterSurface& surface : *surfaces)
                for (const RasterChunk& chunk : surface.chunks)
                    sum += chunk.bytes();
    }
    return sum;
}

std::shared_ptr<const RasterShape> RasterShapeCache::build(const Request& request) {
    ++_built;
    auto shape = std::make_shared<RasterShape>();
    TessellationOptions options;
    options.shutterOpen = options.shutterClose = request.timeCode;
    options.targetEdge = options.roundEdge = request.edge;
    options.edgeBudget = request.edgeBudget;
    const auto made = _compiled.shape({request.prim, options, request.displacers, request.toWorld});
    const bool faces =
        request.prim->kind == GeometryKind::Mesh || request.prim->kind == GeometryKind::Implicit;
    if (_retains && (request.edge == 0.0f || !faces)) _retained.push_back(made);
    if (faces) {
        const TriangleMesh& mesh = made->mesh;
        if (mesh.positions.empty() || mesh.triangles.empty()) return shape;
        describe(*shape, mesh);
        RasterSurfaceBuilder builder(mesh, _heap, storageLimit(), HeldFences::mostTriangles());
        for (size_t subset = 0; subset < request.primvars.size(); ++subset)
            shape->surfaces.push_back(
                builder.make(subset, request.primvars[subset], request.tangentSets[subset]));
        if (request.needsMesh) shape->mesh = std::shared_ptr<const TriangleMesh>(made, &mesh);
        return shape;
    }
    RasterFineness fineness;
    fineness.gap = RasterDetail::largestGap * request.edge;
    if (request.strips) fineness.thick = request.edge;
    RasterForm form = rasterTriangles(*made, fineness);
    TriangleMesh& mesh = form.seen.mesh;
    if (mesh.positions.empty() || mesh.triangles.empty()) return shape;
    describe(*shape, mesh);
    if (!form.casting.mesh.triangles.empty()) shape->flags = RasterShape::tube;
    if (!form.seen.halfWidth.empty()) shape->flags = RasterShape::strip;
    const auto fill = [&](const RasterTriangles& triangles, std::vector<RasterSurface>& surfaces) {
        if (triangles.mesh.triangles.empty()) return;
        RasterSurfaceBuilder builder(triangles, _heap, storageLimit(), HeldFences::mostTriangles());
        for (size_t subset = 0; subset < request.primvars.size(); ++subset)
            surfaces.push_back(
                builder.make(subset, request.primvars[subset], request.tangentSets[subset]));
    };
    fill(form.seen, shape->surfaces);
    fill(form.casting, shape->casting);
    if (request.needsMesh) shape->mesh = std::make_shared<TriangleMesh>(std::move(mesh));
    return shape;
}

} // namespace patina

#include "hdDelegate/compiled/compiledShapes.h"

#include "hdDelegate/geometry/displace.h"
#include "hdDelegate/geometry/splitTriangles.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <array>

namespace patina {

namespace {

bool moves(const Geometry& prim) {
    return prim.kind == GeometryKind::Mesh && static_cast<const Mesh&>(prim).points.moves();
}

/// Times make no difference to what stands still, nor edges to faces that are drawn as they are.
std::array<double, 7> numbersOf(const ShapeRequest& request) {
    const TessellationOptions& o = request.options;
    const bool stands = !moves(*request.prim);
    return {stands ? 0.0 : double(o.shutterOpen),
            stands ? 0.0 : double(o.shutterClose),
            double(o.targetEdge),
            request.prim->kind == GeometryKind::Implicit ? double(o.roundEdge) : 0.0,
            double(o.edgeBudget),
            double(o.maxRefineLevel),
            double(o.triangleBudget)};
}

} // namespace

bool ShapeRequest::displaces() const {
    return std::any_of(displacers.begin(), displacers.end(),
                       [](const auto& program) { return program != nullptr; });
}

bool ShapeRequest::operator==(const ShapeRequest& other) const {
    if (prim != other.prim || numbersOf(*this) != numbersOf(other)) return false;
    if (!displaces() || !other.displaces()) return displaces() == other.displaces();
    return displacers == other.displacers && toWorld == other.toWorld;
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

bool CompiledShapes::Entry::isOf(const ShapeRequest& wanted) const {
    if (request.prim) return request == wanted;
    ShapeRequest own = request;
    own.prim = prim.lock();
    if (!own.prim) return false;
    for (const auto& displacer : displacers) {
        own.displacers.push_back(displacer.lock());
        if (!own.displacers.back()) return false;
    }
    return own == wanted;
}

void CompiledShapes::Entry::letGo() {
    if (request.displaces() && std::count(request.displacers.begin(), request.displacers.end(),
                                          nullptr) > 0)
        return; // some faces are displaced, some are not: rare, and kept as they are
    prim = request.prim;
    if (request.displaces())
        displacers.assign(request.displacers.begin(), request.displacers.end());
    request.prim = nullptr;
    request.displacers.clear();
}

void CompiledShapes::forgetUnused() {
    if (_entries.size() < _forgetAt) return;
    for (auto it = _entries.begin(); it != _entries.end();)
        it = !it->second.pending.valid() && it->second.made.expired() ? _entries.erase(it)
                                                                      : std::next(it);
    _forgetAt = std::max<size_t>(64, 2 * _entries.size());
}

std::shared_ptr<const TriangleMesh> CompiledShapes::triangles(const ShapeRequest& request) {
    std::promise<Triangles> promise;
    std::multimap<const Geometry*, Entry>::iterator entry;
    {
        std::unique_lock<std::mutex> lock(_mutex);
        const auto range = _entries.equal_range(request.prim.get());
        for (auto it = range.first; it != range.second; ++it) {
            if (!it->second.isOf(request)) continue;
            if (Triangles known = it->second.made.lock()) return known;
            if (!it->second.pending.valid()) continue;
            const std::shared_future<Triangles> pending = it->second.pending;
            lock.unlock();
            return pending.get();
        }
        forgetUnused();
        entry = _entries.emplace(
            request.prim.get(), Entry{request, {}, promise.get_future().share(), {}, {}});
        ++_made;
    }
    Triangles made;
    try {
        // A thread that took up another mesh while it waits could wait for one that waits for this.
        runIsolated([&] {
            made = std::make_shared<const TriangleMesh>(makeTriangles(request, _diagnostics));
        });
        promise.set_value(made);
    } catch (...) {
        promise.set_exception(std::current_exception());
        const std::lock_guard<std::mutex> lock(_mutex);
        _entries.erase(entry);
        throw;
    }
    const std::lock_guard<std::mutex> lock(_mutex);
    entry->second.made = made;
    entry->second.pending = {};
    entry->second.letGo();
    return made;
}

size_t CompiledShapes::made() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _made;
}

} // namespace patina

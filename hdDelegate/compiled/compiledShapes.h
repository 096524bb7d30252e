#pragma once

#include "hdDelegate/geometry/tessellate.h"
#include "materialNetwork/cpu/materialProgram.h"

#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace patina {

/// What the triangles of a mesh or of an implicit prim are made from.
struct ShapeRequest {
    std::shared_ptr<const Geometry> prim;
    TessellationOptions options;
    /// Materials that displace() takes; empty, or all null: nothing is displaced.
    std::vector<std::shared_ptr<const MaterialProgram>> displacers;
    mat4 toWorld{1.0f}; ///< that displacement sees

    bool displaces() const;
    /// Whether another request asks for the same triangles.
    bool operator==(const ShapeRequest& other) const;
};

/// Tessellates, cuts and displaces. Object space.
TriangleMesh makeTriangles(const ShapeRequest& request, Diagnostics& diagnostics);

/// The triangles of a scene's prims, made once for all who ask for the same, at any number of
/// levels. Who needs them holds them; what nobody holds is forgotten. Thread safe: who asks for
/// what another thread makes waits for it.
class CompiledShapes {
public:
    explicit CompiledShapes(Diagnostics& diagnostics) : _diagnostics(diagnostics) {}

    std::shared_ptr<const TriangleMesh> triangles(const ShapeRequest& request);
    size_t made() const; ///< since this was made

private:
    using Triangles = std::shared_ptr<const TriangleMesh>;
    struct Entry {
        ShapeRequest request; ///< without the prim and materials once the triangles are made
        std::weak_ptr<const TriangleMesh> made;
        std::shared_future<Triangles> pending; ///< while a thread makes it
        std::weak_ptr<const Geometry> prim;
        std::vector<std::weak_ptr<const MaterialProgram>> displacers;

        bool isOf(const ShapeRequest& wanted) const;
        /// Holds prim and materials no longer: an edited mesh lives on only where it is shown.
        void letGo();
    };
    void forgetUnused();

    Diagnostics& _diagnostics;
    mutable std::mutex _mutex;
    std::multimap<const Geometry*, Entry> _entries;
    size_t _made = 0, _forgetAt = 64; ///< so many entries are looked through
};

} // namespace patina

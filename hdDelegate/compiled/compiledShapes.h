// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/madeOnce.h"
#include "hdDelegate/geometry/tessellate.h"
#include "materialNetwork/cpu/materialProgram.h"

#include <array>
#include <vector>

namespace patina {

/// The inputs that the shape of a prim is made from.
struct ShapeRequest {
    std::shared_ptr<const Geometry> prim;
    TessellationOptions options;
    /// Materials that displace() takes; empty, or all null: nothing is displaced.
    std::vector<std::shared_ptr<const MaterialProgram>> displacers;
    mat4 toWorld{1.0f}; ///< that displacement sees: displacementSpace()

    bool displaces() const;
};

/// The world of displacement: a prim where it is in the middle of the shutter. Prims of
/// prototypes are displaced once for all instances, in the space of their group.
mat4 displacementSpace(const Geometry& prim, float timeCode);

/// A prim ready to be drawn, in its own space: the one of these that its kind asks for.
struct PrimShape {
    TriangleMesh mesh; ///< of meshes and implicit prims
    CurveSet curves;
    PointSet points;
};

/// Tessellates, cuts and displaces, or takes curves and points apart.
PrimShape makeShape(const ShapeRequest& request, Diagnostics& diagnostics);

/// The shapes of a scene's prims, made once for all who ask for the same, at any number of levels.
/// Who needs them holds them; what nobody holds is forgotten. Thread safe.
class CompiledShapes {
public:
    explicit CompiledShapes(Diagnostics& diagnostics) : _diagnostics(diagnostics) {}

    std::shared_ptr<const PrimShape> shape(const ShapeRequest& request);
    size_t made() const { return _shapes.count(); } ///< since this was made

private:
    /// Holds neither prim nor materials: an edited mesh lives on only where it is shown.
    class Key {
    public:
        Key(const ShapeRequest& request);
        bool isOf(const ShapeRequest& request) const;

    private:
        Reference<const Geometry> _prim;
        std::array<double, 8> _numbers;
        std::vector<Reference<const MaterialProgram>> _displacers; ///< empty: nothing is displaced
        mat4 _toWorld;
    };

    Diagnostics& _diagnostics;
    MadeOnce<ShapeRequest, Key, PrimShape> _shapes;
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledShapes.h"
#include "hdDelegate/raster/scene/rasterSurface.h"
#include "hdDelegate/scene/geometry.h"
#include "materialNetwork/cpu/materialProgram.h"

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>

namespace patina {

/// A prim tessellated, in buffers.
struct RasterShape {
    static constexpr int faceted = 2; ///< has no normals
    static constexpr int tube = 4;    ///< round, whatever its triangles are; tangents go along
    static constexpr int strip = 8;   ///< see RasterTriangles

    vec3 boundsMin{0.0f}, boundsMax{0.0f};    ///< object space
    std::vector<RasterSurface> surfaces;      ///< [0] the prim's material, [i + 1] that of subset i
    std::vector<RasterSurface> casting;       ///< the same for shadow maps; empty: as it is seen
    std::shared_ptr<const TriangleMesh> mesh; ///< only where it was asked for
    size_t triangles = 0;
    int flags = 0; ///< of the shader's drawInfo
};

/// Shapes, for as long as nothing changes that they are made of.
class RasterShapeCache {
public:
    /// The inputs that a shape is made of.
    struct Request {
        std::shared_ptr<const Geometry> prim;
        /// Longest edge, object units; 0: as authored. Of curves and points: the width of a pixel.
        float edge = 0.0f;
        size_t edgeBudget = SIZE_MAX; ///< triangles that edges alone ask for; follows from both
        float timeCode = 0.0f;        ///< of points that move
        std::vector<std::vector<std::string>> primvars; ///< that materials read, per surface
        std::vector<std::string> tangentSets;           ///< of the materials
        /// Null where nothing displaces.
        std::vector<std::shared_ptr<const MaterialProgram>> displacers;
        mat4 toWorld{1.0f}; ///< that displacement sees
        bool needsMesh = false;
        bool strips = true; ///< thin curves may be strips
    };

    explicit RasterShapeCache(CompiledShapes& compiled) : _compiled(compiled) {}

    /// Whether shapes that do not depend on the camera are retained, once they are in buffers, for
    /// another back end of the scene, until release().
    void retainFixed(bool retains) { _retains = retains; }
    void release() { _retained.clear(); }

    /// @returns a shape, which is empty when the prim shows nothing
    std::shared_ptr<const RasterShape> get(const Request& request);
    /// Forgets the shapes that nobody has asked for since the last call.
    void forgetUnused();

    /// Forgets shapes that nobody holds, once there are as many of them as of the others.
    void forgetReplaced();
    size_t built() const { return _built; } ///< shapes, since this was made
    size_t bytes() const;                   ///< of all buffers

private:
    struct Entry {
        Request request;
        std::shared_ptr<const RasterShape> shape;
        bool used = false;
    };
    std::shared_ptr<const RasterShape> build(const Request& request);

    CompiledShapes& _compiled;
    BufferHeap _heap;
    bool _retains = false;
    std::vector<std::shared_ptr<const PrimShape>> _retained;
    std::map<std::tuple<std::string, float, float>, Entry> _entries; ///< by name, edge and time
    size_t _forgetAt = 64; ///< so many entries are looked through
    size_t _built = 0;
};

} // namespace patina

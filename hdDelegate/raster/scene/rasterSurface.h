// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/tangentFrames.h"
#include "hdDelegate/raster/gl/bufferHeap.h"
#include "hdDelegate/raster/scene/rasterShapes.h"

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace patina {

#define PATINA_STRUCT TriangleRows
#define PATINA_FIELDS "shaders/raster/triangleFields.glsl"
#include "shaders/gpuStruct.inc"

/// Triangles in one range of a buffer: vertices (position, normal), primvars (a vec4 each per
/// vertex), what belongs to whole triangles, and indices.
class RasterChunk {
public:
    using Triangle = TriangleRows; ///< as shaders/raster/triangles.glsl has it
    struct Vertex {
        vec3 position;
        float halfWidth = 0.0f; ///< of strips, see RasterTriangles
        vec3 normal{0.0f};
    };

    RasterChunk(BufferHeap& heap, const std::vector<Vertex>& vertices,
                const std::vector<vec4>& primvars, const std::vector<Triangle>& triangles,
                const std::vector<uint32_t>& indices);

    /// Binds the buffer: vertices and indices to a vertex array (binding 0), and where something
    /// shades with them the rest to storage bindings 2 and 6.
    void bind(GLuint vertexArray, bool shades) const;
    bool sharesBindings(const RasterChunk& o) const {
        return _range.buffer().id() == o._range.buffer().id();
    }
    GLuint indexCount() const { return _indexCount; }
    // Where it begins in what is bound.
    GLuint firstIndex() const { return GLuint(_indices / sizeof(uint32_t)); }
    GLint firstVertex() const { return GLint(_vertices / sizeof(Vertex)); }
    int firstTriangle() const { return _range.alone() ? 0 : int(_triangles / sizeof(Triangle)); }
    int firstPrimvar() const { return _range.alone() ? 0 : int(_primvars / sizeof(vec4)); }
    size_t bytes() const { return _range.size(); }

private:
    BufferHeap::Range _range;
    size_t _vertices = 0, _primvars = 0, _triangles = 0, _indices = 0; ///< bytes of the buffer
    GLuint _indexCount = 0;
};

/// The triangles of one prim that share a material.
struct RasterSurface {
    std::vector<RasterChunk> chunks;
    int primvarBits = 0; ///< of the primvars asked for: those that the mesh has
    size_t triangles = 0;
};

/// Makes surfaces of one mesh. Corners that agree in all they carry become one vertex.
class RasterSurfaceBuilder {
public:
    static constexpr size_t noLimit = ~size_t(0);

    /// @param heap of the buffers; like mesh and triangles it must outlive this
    /// @param storageLimit in bytes, of what one storage binding shows; more triangles go into
    ///        further chunks
    /// @param mostTriangles of a chunk
    RasterSurfaceBuilder(const TriangleMesh& mesh, BufferHeap& heap, size_t storageLimit,
                         size_t mostTriangles = noLimit);
    RasterSurfaceBuilder(const RasterTriangles& triangles, BufferHeap& heap, size_t storageLimit,
                         size_t mostTriangles = noLimit);

    /// @param subset as of TriangleMesh::triangleSubset
    /// @param primvars that a material reads, in its order
    /// @param tangentSet of the material
    RasterSurface make(size_t subset, const std::vector<std::string>& primvars,
                       const std::string& tangentSet = {});

private:
    uint32_t vertex(unsigned triangle, int corner);
    RasterChunk::Triangle triangle(unsigned t) const;
    RasterChunk take();

    const TriangleMesh& _mesh;
    BufferHeap& _heap;
    const RasterTriangles* _form = nullptr;
    size_t _storageLimit, _mostTriangles;
    const MeshAttribute* _tangents = nullptr; ///< the uv set that they follow, or null
    std::vector<MeshPrimvar> _attributes;
    bool _sharesAll = false;             ///< every corner at a position carries the same
    std::vector<uint32_t> _first, _next; ///< vertices of the chunk at a position: a list
    std::vector<uint32_t> _used;         ///< positions with a list
    std::vector<RasterChunk::Vertex> _vertices;
    std::vector<vec4> _primvars;
    std::vector<RasterChunk::Triangle> _triangles;
    std::vector<uint32_t> _indices;
};

} // namespace patina

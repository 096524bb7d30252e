// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterSurface.h"

#include "hdDelegate/geometry/primvarEval.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace patina {

namespace {

constexpr uint32_t none = ~0u;

template <class T>
size_t append(std::vector<char>& bytes, size_t alignment, const std::vector<T>& values) {
    const size_t offset = (bytes.size() + alignment - 1) / alignment * alignment;
    bytes.resize(offset + std::max<size_t>(values.size() * sizeof(T), 16));
    if (!values.empty()) std::memcpy(&bytes[offset], values.data(), values.size() * sizeof(T));
    return offset;
}

} // namespace

RasterChunk::RasterChunk(BufferHeap& heap, const std::vector<Vertex>& vertices,
                         const std::vector<vec4>& primvars, const std::vector<Triangle>& triangles,
                         const std::vector<uint32_t>& indices)
    : _indexCount(GLuint(indices.size())) {
    static_assert(BufferHeap::grain % sizeof(Vertex) == 0 &&
                  BufferHeap::grain % sizeof(Triangle) == 0 &&
                  BufferHeap::grain % sizeof(vec4) == 0);
    std::vector<char> bytes;
    const auto fill = [&](size_t alignment) {
        bytes.clear();
        _vertices = append(bytes, alignment, vertices);
        _primvars = append(bytes, alignment, primvars);
        _triangles = append(bytes, alignment, triangles);
        _indices = append(bytes, alignment, indices);
    };
    fill(BufferHeap::grain);
    // One that is large has storage bindings of its own parts, for which drivers may ask for a
    // multiple of 256: a binding cannot show all of the buffer.
    const bool alone = BufferHeap::isAlone(bytes.size());
    if (alone) fill(256);
    _range = heap.make(bytes, alone);
    for (size_t* offset : {&_vertices, &_primvars, &_triangles, &_indices})
        *offset += _range.offset();
}

void RasterChunk::bind(GLuint vertexArray, bool shades) const {
    const GlBuffer& buffer = _range.buffer();
    gl.VertexArrayVertexBuffer(vertexArray, 0, buffer.id(), 0, sizeof(Vertex));
    gl.VertexArrayElementBuffer(vertexArray, buffer.id());
    if (!shades) return;
    if (_range.alone()) {
        buffer.bindStorage(2, _triangles, _indices - _triangles);
        buffer.bindStorage(6, _primvars, _triangles - _primvars);
    } else {
        buffer.bindStorage(2);
        buffer.bindStorage(6);
    }
}

RasterSurfaceBuilder::RasterSurfaceBuilder(const TriangleMesh& mesh, BufferHeap& heap,
                                           size_t storageLimit, size_t mostTriangles)
    : _mesh(mesh), _heap(heap), _storageLimit(storageLimit), _mostTriangles(mostTriangles),
      _first(mesh.positions[0].size(), none) {}

RasterSurfaceBuilder::RasterSurfaceBuilder(const RasterTriangles& triangles, BufferHeap& heap,
                                           size_t storageLimit, size_t mostTriangles)
    : RasterSurfaceBuilder(triangles.mesh, heap, storageLimit, mostTriangles) {
    _form = &triangles;
}

RasterSurface RasterSurfaceBuilder::make(size_t subset, const std::vector<std::string>& primvars,
                                         const std::string& tangents) {
    using Rate = MeshAttribute::Rate;
    RasterSurface surface;
    _attributes.clear();
    _tangents = tangentSet(_mesh, tangents);
    _sharesAll = _mesh.normals.empty() || _mesh.normalRate == Rate::PerVertex;
    for (const std::string& name : primvars) {
        const MeshPrimvar own(_mesh, name);
        if (own.attribute) {
            surface.primvarBits |= 1 << _attributes.size();
            const Rate rate = own.attribute->rate;
            _sharesAll &= !own.tangents && (rate == Rate::PerVertex || rate == Rate::Constant);
        }
        _attributes.push_back(own);
    }
    const size_t perTriangle = std::max(sizeof(RasterChunk::Triangle),
                                        3 * sizeof(vec4) * std::max<size_t>(1, primvars.size()));
    const size_t maximum =
        std::max<size_t>(1, std::min(_mostTriangles, _storageLimit / perTriangle));
    for (unsigned t = 0; t < _mesh.triangles.size(); ++t) {
        const size_t own = t < _mesh.triangleSubset.size() ? _mesh.triangleSubset[t] : 0;
        if (own != subset) continue;
        if (_triangles.size() == maximum) surface.chunks.push_back(take());
        for (int c = 0; c < 3; ++c)
            _indices.push_back(vertex(t, c));
        _triangles.push_back(triangle(t));
        ++surface.triangles;
    }
    if (!_triangles.empty()) surface.chunks.push_back(take());
    return surface;
}

uint32_t RasterSurfaceBuilder::vertex(unsigned t, int c) {
    const uint32_t position = _mesh.triangles[t][c];
    uint32_t& first = _first[position];
    if (_sharesAll && first != none) return first;
    const float u = c == 1 ? 1.0f : 0.0f, v = c == 2 ? 1.0f : 0.0f;
    RasterChunk::Vertex own;
    own.position = _mesh.positions[0][position];
    if (_form && !_form->halfWidth.empty()) own.halfWidth = _form->halfWidth[position];
    if (!_mesh.normals.empty()) own.normal = evalNormal(_mesh, t, u, v);
    if (_form && !_form->ends.empty()) own.normal *= _form->ends[position];
    const size_t count = _attributes.size(), at = _primvars.size();
    for (const MeshPrimvar& attribute : _attributes) {
        float value[4] = {0, 0, 0, 0};
        attribute.read(_mesh, t, u, v, value);
        _primvars.emplace_back(value[0], value[1], value[2], value[3]);
    }
    // Sharing saves memory, and no more: of very many values at one point some are looked at.
    int tries = 64;
    for (uint32_t other = first; other != none && tries > 0; other = _next[other], --tries)
        if (_vertices[other].normal == own.normal &&
            std::equal(_primvars.begin() + std::ptrdiff_t(at), _primvars.end(),
                       _primvars.begin() + std::ptrdiff_t(other * count))) {
            _primvars.resize(at);
            return other;
        }
    if (first == none) _used.push_back(position);
    const uint32_t made = uint32_t(_vertices.size());
    _vertices.push_back(own);
    _next.push_back(first);
    return first = made;
}

RasterChunk::Triangle RasterSurfaceBuilder::triangle(unsigned t) const {
    RasterChunk::Triangle out;
    const uvec3 tri = _mesh.triangles[t];
    const auto& positions = _mesh.positions[0];
    const vec3 p[3] = {positions[tri.x], positions[tri.y], positions[tri.z]};
    out.normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    out.element = t < _mesh.triangleFace.size() ? _mesh.triangleFace[t] : int(t);
    if (_form && !_form->along.empty()) {
        out.dPdu = _form->along[t];
        out.slope = _form->slope[t];
        return out;
    }
    const TangentFrame frame = _tangents ? tangentFrame(_mesh, _tangents, t) : TangentFrame();
    if (!frame.fromTexture) return out;
    out.dPdu = frame.dpdu;
    out.dPdv = frame.dpdv;
    out.uvPerLength = frame.uvPerLength;
    return out;
}

RasterChunk RasterSurfaceBuilder::take() {
    RasterChunk chunk(_heap, _vertices, _primvars, _triangles, _indices);
    for (const uint32_t position : _used)
        _first[position] = none;
    _used.clear();
    _next.clear();
    _vertices.clear();
    _primvars.clear();
    _triangles.clear();
    _indices.clear();
    return chunk;
}

} // namespace patina

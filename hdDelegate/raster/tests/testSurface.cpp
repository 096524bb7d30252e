// SPDX-License-Identifier: Apache-2.0
// Meshes become buffers: corners that agree share a vertex, those that do not are kept apart.

#include "hdDelegate/raster/scene/rasterSurface.h"
#include "hdDelegate/raster/tests/rasterFixture.h"

#include <algorithm>

using namespace patina;

namespace {

/// Two triangles of a square that share an edge.
TriangleMesh square() {
    TriangleMesh mesh;
    mesh.positions = {{vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0)}};
    mesh.triangles = {uvec3(0, 1, 2), uvec3(0, 2, 3)};
    mesh.triangleFace = {5, 9};
    mesh.normals = {std::vector<vec3>(4, vec3(0, 0, 1))};
    return mesh;
}

/// The layout of a chunk's buffer: bytes for so many vertices, primvars, triangles and indices.
size_t bytesOf(size_t vertices, size_t primvars, size_t triangles) {
    const auto up = [](size_t n) {
        return (n + BufferHeap::grain - 1) / BufferHeap::grain * BufferHeap::grain;
    };
    return up(vertices * 28) + up(std::max<size_t>(16, primvars * 16)) + up(triangles * 48) +
           triangles * 12;
}

} // namespace

TEST(RasterSurface, SmoothCornersShareVertices) {
    PATINA_NEED_CONTEXT();
    BufferHeap heap;
    TriangleMesh mesh = square();
    mesh.attributes = {{"st", 2, MeshAttribute::Rate::PerVertex, {0, 0, 1, 0, 1, 1, 0, 1}}};
    RasterSurfaceBuilder builder(mesh, heap, 1 << 24);
    const RasterSurface surface = builder.make(0, {"st", "missing"});
    ASSERT_EQ(surface.chunks.size(), 1u);
    EXPECT_EQ(surface.triangles, 2u);
    EXPECT_EQ(surface.primvarBits, 1);
    EXPECT_EQ(surface.chunks[0].indexCount(), 6u);
    EXPECT_EQ(surface.chunks[0].bytes(), bytesOf(4, 8, 2));
}

TEST(RasterSurface, SeamsKeepTheirCorners) {
    PATINA_NEED_CONTEXT();
    BufferHeap heap;
    TriangleMesh mesh = square();
    // The second triangle's corner at vertex 2 has another value.
    mesh.attributes = {{"a", 1, MeshAttribute::Rate::PerCorner, {0, 1, 2, 0, 7, 3}},
                       {"face", 1, MeshAttribute::Rate::Constant, {4}}};
    RasterSurfaceBuilder builder(mesh, heap, 1 << 24);
    EXPECT_EQ(builder.make(0, {"a"}).chunks[0].bytes(), bytesOf(5, 5, 2));
    EXPECT_EQ(builder.make(0, {"face"}).chunks[0].bytes(), bytesOf(4, 4, 2));
    // Normals that differ keep corners apart, too.
    mesh.normalRate = MeshAttribute::Rate::PerCorner;
    mesh.normals = {
        {vec3(0, 0, 1), vec3(0, 0, 1), vec3(0, 0, 1), vec3(1, 0, 0), vec3(1, 0, 0), vec3(1, 0, 0)}};
    RasterSurfaceBuilder hard(mesh, heap, 1 << 24);
    EXPECT_EQ(hard.make(0, {}).chunks[0].bytes(), bytesOf(6, 0, 2));
}

TEST(RasterSurface, VeryManyValuesAtOnePointAreNotAllCompared) {
    PATINA_NEED_CONTEXT();
    BufferHeap heap;
    // A fan of a million triangles, whose corners all differ: a step for each pair would be 10^12.
    constexpr uint32_t count = 1000000;
    TriangleMesh mesh;
    std::vector<vec3> positions = {vec3(0.0f)};
    std::vector<float> values;
    for (uint32_t i = 0; i < count; ++i) {
        positions.emplace_back(float(i), 1.0f, 0.0f);
        mesh.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % count);
        mesh.triangleFace.push_back(int(i));
        values.insert(values.end(), {float(i), 0.0f, 0.0f});
    }
    mesh.positions = {std::move(positions)};
    mesh.attributes = {{"a", 1, MeshAttribute::Rate::PerCorner, std::move(values)}};
    RasterSurfaceBuilder builder(mesh, heap, size_t(1) << 30);
    EXPECT_EQ(builder.make(0, {"a"}).triangles, size_t(count));
}

TEST(RasterSurface, SubsetsAndPiecesHoldEveryTriangleOnce) {
    PATINA_NEED_CONTEXT();
    BufferHeap heap;
    TriangleMesh mesh = square();
    mesh.triangles.clear();
    mesh.triangleFace.clear();
    for (int i = 0; i < 1000; ++i) {
        mesh.triangles.push_back(i % 2 ? uvec3(0, 1, 2) : uvec3(0, 2, 3));
        mesh.triangleFace.push_back(i);
        mesh.triangleSubset.push_back(uint16_t(i % 3 == 0));
    }
    RasterSurfaceBuilder builder(mesh, heap,
                                 48 * 100); // a hundred triangles in one storage binding
    const RasterSurface rest = builder.make(0, {}), part = builder.make(1, {});
    EXPECT_EQ(rest.triangles, 666u);
    EXPECT_EQ(part.triangles, 334u);
    EXPECT_EQ(rest.chunks.size(), 7u);
    EXPECT_EQ(part.chunks.size(), 4u);
    size_t indices = 0;
    for (const RasterSurface* surface : {&rest, &part})
        for (const RasterChunk& chunk : surface->chunks) {
            EXPECT_LE(chunk.indexCount(), 300u);
            indices += size_t(chunk.indexCount());
        }
    EXPECT_EQ(indices, 3000u);
    EXPECT_TRUE(builder.make(2, {}).chunks.empty());
    RasterSurfaceBuilder ofFew(mesh, heap, 1 << 24, 250);
    EXPECT_EQ(ofFew.make(0, {}).chunks.size(), 3u);
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

TEST(BufferHeap, RangesAreApartAndTheirRoomIsUsedAgain) {
    PATINA_NEED_CONTEXT();
    BufferHeap heap;
    const auto filled = [](size_t size, char value) { return std::vector<char>(size, value); };
    const auto holds = [](const BufferHeap::Range& range, char value) {
        std::vector<char> bytes(range.size());
        range.buffer().read(bytes.data(), bytes.size(), range.offset());
        return std::all_of(bytes.begin(), bytes.end(), [&](char c) { return c == value; });
    };
    std::vector<BufferHeap::Range> ranges;
    for (int i = 0; i < 100; ++i)
        ranges.push_back(heap.make(filled(size_t(1 + 37 * i), char(i)), false));
    EXPECT_EQ(heap.pages(), 1u);
    for (int i = 0; i < 100; ++i) {
        EXPECT_TRUE(holds(ranges[size_t(i)], char(i))) << i;
        EXPECT_EQ(ranges[size_t(i)].offset() % BufferHeap::grain, 0u);
    }
    // What neighbours give back is one room.
    const size_t offset = ranges[50].offset();
    const size_t room = ranges[60].offset() - offset;
    ranges.erase(ranges.begin() + 50, ranges.begin() + 60);
    BufferHeap::Range large = heap.make(filled(room, 'x'), false);
    EXPECT_EQ(large.offset(), offset);
    EXPECT_TRUE(holds(ranges[49], 49) && holds(ranges[50], 60));
    const BufferHeap::Range alone = heap.make(filled(10, 'y'), true);
    EXPECT_NE(alone.buffer().id(), large.buffer().id());
    EXPECT_EQ(alone.offset(), 0u);
    large = {};
    ranges.clear();
    EXPECT_EQ(heap.pages(), 0u) << "a page goes with its last range";
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

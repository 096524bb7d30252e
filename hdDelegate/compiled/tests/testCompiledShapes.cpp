// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledShapes.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"

#include "base/tests/testTools.h"

namespace patina {
namespace {

std::shared_ptr<Mesh> cube() {
    return std::make_shared<Mesh>(cubeMesh());
}

struct Shapes : ::testing::Test {
    Diagnostics diagnostics;
    CompiledShapes shapes{diagnostics};
    ShapeRequest request;

    Shapes() { request.prim = cube(); }
    std::shared_ptr<const TriangleMesh> triangles(const ShapeRequest& asked) {
        const auto shape = shapes.shape(asked);
        return {shape, &shape->mesh};
    }
};

TEST_F(Shapes, AreMadeOnceForWhoeverAsks) {
    const auto first = triangles(request);
    EXPECT_EQ(first->triangles.size(), 12u);
    ShapeRequest other = request;
    other.options.shutterClose = 0.5f; // its points stand still
    other.options.roundEdge = 1.0f;    // and it is not round
    other.displacers = {nullptr};
    other.toWorld[3][0] = 5.0f;
    EXPECT_EQ(triangles(other), first);
    EXPECT_EQ(shapes.made(), 1u);
}

TEST_F(Shapes, AreKeptByLevel) {
    auto smooth = cube();
    smooth->scheme = SubdivisionScheme::CatmullClark;
    request.prim = smooth;
    request.options.targetEdge = 0.6f;
    const auto fine = triangles(request);
    request.options.targetEdge = 1.2f;
    const auto coarse = triangles(request);
    EXPECT_EQ(fine->triangles.size(), 4 * coarse->triangles.size());
    request.options.targetEdge = 0.6f;
    EXPECT_EQ(triangles(request), fine);
    EXPECT_EQ(shapes.made(), 2u);
}

TEST_F(Shapes, DependOnTimesWherePointsMove) {
    auto moving = cube();
    movePoints(*moving, [](const vec3& p) { return p; });
    request.prim = moving;
    const auto still = triangles(request);
    request.options.shutterClose = 1.0f;
    EXPECT_NE(triangles(request), still);
}

TEST_F(Shapes, AreForgottenWhenNobodyHoldsThem) {
    std::weak_ptr<const TriangleMesh> watched = triangles(request);
    EXPECT_TRUE(watched.expired());
    const auto again = triangles(request);
    EXPECT_EQ(shapes.made(), 2u);
    request.prim = cube();
    EXPECT_NE(triangles(request), again) << "an edit makes another prim";
    request.prim = cube();
    const std::weak_ptr<const Geometry> prim = request.prim;
    for (int i = 0; i < 200; ++i) {
        triangles(request);
        request.prim = cube();
    }
    EXPECT_TRUE(prim.expired()) << "requests are forgotten too";
}

TEST_F(Shapes, AreMadeOnceForThreadsThatAskTogether) {
    std::vector<std::shared_ptr<const TriangleMesh>> found(8);
    onThreads(8, [&](int i) { found[size_t(i)] = triangles(request); });
    for (const auto& mesh : found)
        EXPECT_EQ(mesh, found[0]);
    EXPECT_EQ(shapes.made(), 1u);
}

} // namespace
} // namespace patina

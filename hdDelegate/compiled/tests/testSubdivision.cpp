// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"

#include <cmath>

namespace patina {
namespace {

/// Two units along each side.
std::shared_ptr<Mesh> cube() {
    return std::make_shared<Mesh>(cubeMesh(SubdivisionScheme::CatmullClark));
}

Camera cameraAt(float z) {
    return *makePrim<Camera>("/camera", translate(0, 0, z));
}

struct Subdivisions : ::testing::Test {
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    std::shared_ptr<CompiledScene> compiled = CompiledScene::of(scene);
    RenderSettings settings;

    Subdivisions() {
        scene->edit().set(cube());
        settings.width = settings.height = 400;
    }
    Subdivision choice(float distance) {
        const auto state = scene->snapshot();
        const CompiledState parts = compiled->compiled(*state, settings);
        return compiled->subdivision().of(*state, *parts.placements, cameraAt(distance), settings);
    }
};

TEST_F(Subdivisions, AreChosenOnceForAllRenderers) {
    settings.tolerance = 0.01;
    const Subdivision first = choice(8.0f);
    EXPECT_EQ(first.method.point, "subdivision");
    settings.samples = 4; // as the two of an interactive session differ
    settings.interactive = true;
    EXPECT_EQ(choice(8.0f).edgeLength, first.edgeLength);
    EXPECT_EQ(compiled->subdivision().planned(), 1u);
    EXPECT_EQ(compiled->extents().measured(), 1u);
    choice(9.0f);
    settings.tolerance = 0.02;
    choice(9.0f);
    EXPECT_EQ(compiled->subdivision().planned(), 3u);
    EXPECT_EQ(compiled->extents().measured(), 1u) << "the prim is as it was";
    scene->edit().set(cube());
    choice(9.0f);
    EXPECT_EQ(compiled->subdivision().planned(), 4u);
    EXPECT_EQ(compiled->extents().measured(), 2u);
}

TEST_F(Subdivisions, AreFinerForASmallerTolerance) {
    settings.tolerance = 0.5;
    const float coarse = choice(8.0f).edgeLength;
    settings.tolerance = 0.001;
    EXPECT_LT(choice(8.0f).edgeLength, coarse);
}

TEST_F(Subdivisions, ArePlannedWhereverTheSceneIs) {
    settings.tolerance = 0.01;
    const float here = choice(8.0f).edgeLength;
    auto far = cube();
    dmat4 place(1.0);
    place[3].x = 3e8; // floats are 32 units apart there
    far->transform = place;
    scene->edit().set(far);
    Camera camera = cameraAt(8.0f);
    camera.transform.values[0][3].x = 3e8;
    const auto state = scene->snapshot();
    const CompiledState parts = compiled->compiled(*state, settings);
    EXPECT_EQ(compiled->subdivision().of(*state, *parts.placements, camera, settings).edgeLength,
              here);
}

TEST_F(Subdivisions, AreThoseOfTheSettingsWhereNothingIsToBeChosen) {
    EXPECT_EQ(choice(8.0f).edgeLength, SubdivisionPlan::standardEdge);
    EXPECT_TRUE(choice(8.0f).method.point.empty());
    settings.edgeLength = 7.0f;
    EXPECT_EQ(choice(8.0f).edgeLength, 7.0f);
    EXPECT_EQ(compiled->extents().measured(), 0u);
}

TEST(Subdivision, IsNoCoarserForDisplacementThanTheStandard) {
    Subdivision subdivision;
    subdivision.edgeLength = 16.0f;
    EXPECT_EQ(subdivision.edgeOf(true), 16.0f) << "as the settings say";
    subdivision.method.point = "subdivision";
    EXPECT_EQ(subdivision.edgeOf(true), SubdivisionPlan::standardEdge);
    EXPECT_EQ(subdivision.edgeOf(false), 16.0f);
    subdivision.method.forced = true;
    EXPECT_EQ(subdivision.edgeOf(true), 16.0f);
}

TEST(PrimExtent, OfACube) {
    auto mesh = cube();
    mesh->points.values[0].push_back(vec3(NAN, 9.0f, 9.0f)); // no face has it
    const PrimExtent extent(*mesh);
    EXPECT_EQ(extent.low, vec3(-1.0f));
    EXPECT_EQ(extent.high, vec3(1.0f));
    EXPECT_FLOAT_EQ(extent.area, 24.0f);
    EXPECT_FLOAT_EQ(extent.across, 2.0f);
    EXPECT_FLOAT_EQ(extent.round, 2.0f) << "six times volume 8 over area 24";
    EXPECT_FLOAT_EQ(extent.radius(), std::sqrt(3.0f));
    EXPECT_TRUE(PrimExtent(Mesh()).empty);
}

TEST(PrimExtent, OfImplicitPrims) {
    Implicit prim;
    prim.radius = 0.5f;
    prim.height = 6.0f;
    prim.axis = 0;
    const auto high = [&](ImplicitShape shape) {
        prim.shape = shape;
        return PrimExtent(prim).high;
    };
    EXPECT_EQ(high(ImplicitShape::Sphere), vec3(0.5f));
    EXPECT_EQ(high(ImplicitShape::Cylinder), vec3(3.0f, 0.5f, 0.5f));
    EXPECT_EQ(high(ImplicitShape::Capsule), vec3(3.5f, 0.5f, 0.5f));
    EXPECT_EQ(high(ImplicitShape::Cube), vec3(1.0f));
    EXPECT_EQ(high(ImplicitShape::Plane), vec3(0.0f, 1.0f, 1.0f));
}

TEST(PrimExtent, OfPointsHasTheirWidths) {
    Points points;
    points.points = std::vector<vec3>{{1, 2, 3}};
    points.primvars = {makePrimvar("widths", Interpolation::Vertex, 1, {4.0f, NAN})};
    const PrimExtent extent(points);
    EXPECT_EQ(extent.low, vec3(-1, 0, 1));
    EXPECT_EQ(extent.high, vec3(3, 4, 5));
}

TEST(ScreenScale, IsThePixelWhereABallIsNearest) {
    ScreenScale screen;
    screen.eye = vec3(0, 0, 10);
    screen.pixelSpread = 0.01f;
    screen.nearest = 0.5f;
    mat4 twice(2.0f);
    twice[3][3] = 1.0f;
    EXPECT_FLOAT_EQ(screen.unit(twice, vec3(0.0f), 1.0f), 0.01f * 8.0f / 2.0f);
    EXPECT_FLOAT_EQ(screen.unit(mat4(1.0f), vec3(0.0f), 20.0f), 0.01f * 0.5f) << "it is inside";
    screen.perspective = false;
    EXPECT_FLOAT_EQ(screen.unit(twice, vec3(0.0f), 1.0f), 0.01f / 2.0f);
}

} // namespace
} // namespace patina

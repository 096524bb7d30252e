// Grids of OpenVDB files, as they were written.

#include "hdDelegate/scene/fieldGrid.h"

#include <gtest/gtest.h>

#ifdef PATINA_HAS_OPENVDB
#include <openvdb/openvdb.h>
#endif

#include <cstdio>

using namespace patina;

TEST(FieldFile, MissingFilesAreReported) {
    Diagnostics diagnostics;
    EXPECT_EQ(readFieldGrid("/does/not/exist.vdb", "density", "/volume", diagnostics), nullptr);
    ASSERT_EQ(diagnostics.count(), 1);
    EXPECT_EQ(diagnostics.all()[0].prim, "/volume");
}

TEST(FieldFile, ValuesTilesAndTransforms) {
#ifndef PATINA_HAS_OPENVDB
    GTEST_SKIP() << "this build has no OpenVDB";
#else
    openvdb::initialize();
    auto density = openvdb::FloatGrid::create(0.0f);
    density->setName("density");
    density->tree().setValue(openvdb::Coord(-9, 3, 20), 2.0f);
    density->tree().fill(openvdb::CoordBBox({0, 0, 0}, {15, 15, 15}), 0.5f);
    openvdb::math::Mat4d m = openvdb::math::Mat4d::identity();
    m.preScale(openvdb::Vec3d(0.5, 0.25, 2.0));
    m.postTranslate(openvdb::Vec3d(1, 2, 3));
    density->setTransform(openvdb::math::Transform::createLinearTransform(m));
    auto color = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.0f));
    color->setName("color");
    color->tree().setValue(openvdb::Coord(1, 2, 3), openvdb::Vec3f(1, 2, 3));
    auto empty = openvdb::FloatGrid::create(0.0f);
    empty->setName("empty");
    const std::string file = testing::TempDir() + "patinaFields.vdb";
    openvdb::io::File(file).write({density, color, empty});

    Diagnostics diagnostics;
    const auto read = readFieldGrid(file, "density", "/volume", diagnostics);
    ASSERT_NE(read, nullptr);
    const auto at = [&](int x, int y, int z) {
        const openvdb::Vec3d p = density->transform().indexToWorld(openvdb::Coord(x, y, z));
        return read->sample(vec3(p.x(), p.y(), p.z())).x;
    };
    EXPECT_NEAR(at(-9, 3, 20), 2.0f, 1e-4f);
    EXPECT_NEAR(at(-8, 3, 20), 0.0f, 1e-4f);
    EXPECT_NEAR(at(4, 5, 6), 0.5f, 1e-4f); // of a tile
    EXPECT_NEAR(at(15, 15, 15), 0.5f, 1e-4f);
    EXPECT_NEAR(at(17, 15, 15), 0.0f, 1e-4f);

    const auto vectors = readFieldGrid(file, "color", "/volume", diagnostics);
    ASSERT_NE(vectors, nullptr);
    EXPECT_EQ(vectors->components(), 3);
    EXPECT_NEAR(vectors->sample(vec3(1, 2, 3)).y, 2.0f, 1e-4f);
    EXPECT_EQ(diagnostics.count(), 0);

    EXPECT_EQ(readFieldGrid(file, "empty", "/volume", diagnostics), nullptr);
    EXPECT_EQ(readFieldGrid(file, "other", "/volume", diagnostics), nullptr);
    EXPECT_EQ(diagnostics.count(), 2);
    std::FILE* bad = std::fopen(file.c_str(), "wb");
    std::fputs("not a grid", bad);
    std::fclose(bad);
    EXPECT_EQ(readFieldGrid(file, "density", "/volume", diagnostics), nullptr);
    std::remove(file.c_str());
#endif
}

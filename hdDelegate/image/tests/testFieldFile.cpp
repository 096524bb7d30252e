// SPDX-License-Identifier: Apache-2.0
// Grids of OpenVDB files, as they were written.

#include "base/limits.h"
#include "base/tests/testTools.h"
#include "hdDelegate/film/tests/tempFolder.h"
#include "hdDelegate/image/fieldGrids.h"

#ifdef PATINA_HAS_OPENVDB
#include <openvdb/openvdb.h>
#endif

#include <sys/stat.h>

using namespace patina;

namespace {

class FieldFile : public testing::Test {
protected:
    TempFolder temp;
    const std::string file = temp.file("grids.vdb");
    Diagnostics diagnostics;

    std::shared_ptr<const FieldGrid> read(const std::string& name) {
        return readFieldGrid(file, name, "/volume", diagnostics);
    }
};

} // namespace

TEST_F(FieldFile, MissingFilesAreReported) {
    EXPECT_EQ(read("density"), nullptr);
    EXPECT_EQ(onlyWarning(diagnostics).find("/volume "), 0u);
}

TEST_F(FieldFile, OnlyRegularFilesAreRead) {
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    EXPECT_EQ(read("density"), nullptr); // would wait
    EXPECT_EQ(readFieldGrid("/dev/zero", "density", "/volume", diagnostics), nullptr);
    EXPECT_EQ(diagnostics.count(), 2);
#ifdef PATINA_HAS_OPENVDB
    for (const Diagnostic& found : diagnostics.all())
        EXPECT_TRUE(has(found.message, "not a regular file")) << found.message;
#endif
}

#ifndef PATINA_HAS_OPENVDB
TEST_F(FieldFile, OfOpenVdb) {
    GTEST_SKIP() << "this build has no OpenVDB";
}
#else

namespace {

template <class Grid> typename Grid::Ptr gridOf(const std::string& name) {
    openvdb::initialize();
    auto grid = Grid::create(typename Grid::ValueType(0.0f));
    grid->setName(name);
    return grid;
}

openvdb::Vec3SGrid::Ptr colorGrid() {
    auto color = gridOf<openvdb::Vec3SGrid>("color");
    color->tree().setValue(openvdb::Coord(1, 2, 3), openvdb::Vec3f(1, 2, 3));
    return color;
}

/// A file of a sparse grid of numbers and one of vectors.
void writeGrids(const std::string& file) {
    auto density = gridOf<openvdb::FloatGrid>("density");
    for (int i = 0; i < 12; ++i)
        density->tree().setValue(openvdb::Coord(i * 5, i * 3, i), 1.0f + float(i));
    openvdb::io::File(file).write({density, colorGrid()});
}

} // namespace

TEST_F(FieldFile, ValuesTilesAndTransforms) {
    auto density = gridOf<openvdb::FloatGrid>("density");
    density->tree().setValue(openvdb::Coord(-9, 3, 20), 2.0f);
    density->tree().fill(openvdb::CoordBBox({0, 0, 0}, {15, 15, 15}), 0.5f);
    openvdb::math::Mat4d m = openvdb::math::Mat4d::identity();
    m.preScale(openvdb::Vec3d(0.5, 0.25, 2.0));
    m.postTranslate(openvdb::Vec3d(1, 2, 3));
    density->setTransform(openvdb::math::Transform::createLinearTransform(m));
    openvdb::io::File(file).write({density, colorGrid(), gridOf<openvdb::FloatGrid>("empty")});

    const auto grid = read("density");
    ASSERT_NE(grid, nullptr);
    const auto at = [&](int x, int y, int z) {
        const openvdb::Vec3d p = density->transform().indexToWorld(openvdb::Coord(x, y, z));
        return grid->sample(vec3(p.x(), p.y(), p.z())).x;
    };
    EXPECT_NEAR(at(-9, 3, 20), 2.0f, 1e-4f);
    EXPECT_NEAR(at(-8, 3, 20), 0.0f, 1e-4f);
    EXPECT_NEAR(at(4, 5, 6), 0.5f, 1e-4f); // of a tile
    EXPECT_NEAR(at(15, 15, 15), 0.5f, 1e-4f);
    EXPECT_NEAR(at(17, 15, 15), 0.0f, 1e-4f);

    const auto vectors = read("color");
    ASSERT_NE(vectors, nullptr);
    EXPECT_EQ(vectors->components(), 3);
    EXPECT_NEAR(vectors->sample(vec3(1, 2, 3)).y, 2.0f, 1e-4f);
    EXPECT_EQ(diagnostics.count(), 0);

    EXPECT_EQ(read("empty"), nullptr);
    EXPECT_EQ(read("other"), nullptr);
    EXPECT_EQ(diagnostics.count(), 2);
    writeFile(file, "not a grid");
    EXPECT_EQ(read("density"), nullptr);
}

TEST_F(FieldFile, DamagedFilesAreReportedAndEndNothing) {
    writeGrids(file);
    const std::string good = bytesOfFile(file);
    ASSERT_GT(good.size(), 12000u);
    const auto readDamaged = [&](const std::string& bytes) {
        writeFile(file, bytes);
        diagnostics.clear();
        const bool whole = bool(read("density"));
        EXPECT_EQ(diagnostics.count(), whole ? 0 : 1);
        const std::string message = whole ? "" : diagnostics.all()[0].message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    };
    EXPECT_EQ(readDamaged(good), "");
    // Where nodes are counted: OpenVDB 10 overruns its memory on one of these, and aborts.
    for (size_t at = 8500; at <= 10500; at += 250) {
        std::string bytes = good;
        bytes.replace(at, 256, 256, '\xff');
        readDamaged(bytes);
    }
    for (size_t part : {8, 5, 3})
        EXPECT_NE(readDamaged(good.substr(0, good.size() * part / 9)), "") << "broken off";
    EXPECT_EQ(readDamaged(good), "") << "reading goes on working";
}

TEST_F(FieldFile, VoxelsTakeNoMoreThanALimit) {
    auto density = gridOf<openvdb::FloatGrid>("density");
    density->tree().addTile(2, openvdb::Coord(0), 1.0f, true); // 128 voxels wide, of one number
    openvdb::io::File(file).write({density});
    EXPECT_NE(read("density"), nullptr);
    setLimits({{"textureBytes", 1000000}});
    EXPECT_EQ(read("density"), nullptr);
    setLimits({});
    EXPECT_TRUE(has(onlyMessage(diagnostics), "--limit textureBytes"));
}

TEST_F(FieldFile, GridsAreSharedAndTogetherWithinALimit) {
    openvdb::GridPtrVec written;
    for (const char* name : {"density", "heat"}) {
        auto grid = gridOf<openvdb::FloatGrid>(name);
        // Two voxels far from each other: 64 bricks along each axis, a megabyte of places.
        for (const int at : {0, 511})
            grid->tree().setValueOn(openvdb::Coord(at), 1.0f);
        written.push_back(grid);
    }
    openvdb::io::File(file).write(written);
    FieldGrids grids;
    const auto first = grids.read(file, "density", "/a", diagnostics);
    ASSERT_TRUE(first);
    EXPECT_EQ(grids.read(file, "density", "/b", diagnostics), first);
    EXPECT_GT(first->bytes(), 1000000u);
    setLimits({{"gridBytes", 2 * first->bytes() - 1}});
    EXPECT_EQ(grids.read(file, "density", "/b", diagnostics), first);
    EXPECT_EQ(grids.read(file, "heat", "/b", diagnostics), nullptr);
    EXPECT_TRUE(has(onlyMessage(diagnostics), "--limit gridBytes"));
    setLimits({{"textureBytes", 1000000}});
    EXPECT_EQ(read("heat"), nullptr) << "places count as well";
    setLimits({});
    EXPECT_NE(grids.read(file, "heat", "/b", diagnostics), nullptr);
}

TEST_F(FieldFile, GridsAreReadOnManyThreadsAtOnce) {
    writeGrids(file);
    onThreads(4, [&](int) {
        const auto grid = read("density");
        ASSERT_NE(grid, nullptr);
        EXPECT_NEAR(grid->sample(vec3(55, 33, 11)).x, 12.0f, 1e-4f);
        EXPECT_NE(read("color"), nullptr);
    });
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST_F(FieldFile, NamesMayBeAnyBytes) {
    writeGrids(file);
    EXPECT_EQ(read("\xff\xfe"), nullptr);
    EXPECT_TRUE(has(onlyMessage(diagnostics), "\xEF\xBF\xBD")) << "what is told is UTF-8";
}

#endif

// The only file that knows OpenVDB.
#include "hdDelegate/scene/fieldGrid.h"

#ifdef PATINA_HAS_OPENVDB
#include <openvdb/openvdb.h>

#include <mutex>
#endif

namespace patina {

#ifdef PATINA_HAS_OPENVDB

namespace {

constexpr int64_t mostBricks = int64_t(1) << 27; ///< places: the box of a grid may be this large

float component(float v, int) {
    return v;
}
float component(double v, int) {
    return float(v);
}
float component(const openvdb::Vec3f& v, int c) {
    return v[c];
}
float component(const openvdb::Vec3d& v, int c) {
    return float(v[c]);
}

template <class Grid>
std::shared_ptr<const FieldGrid> copy(const Grid& grid, int components, std::string& problem) {
    using openvdb::Coord;
    constexpr int edge = FieldGrid::edge;
    const auto affine = grid.transform().baseMap();
    if (!affine || !affine->isLinear()) {
        problem = "the grid's transform is not affine";
        return nullptr;
    }
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) {
        problem = "the grid is empty";
        return nullptr;
    }
    const auto down = [](int x) { return x & ~(edge - 1); };
    const ivec3 first(down(box.min().x()), down(box.min().y()), down(box.min().z()));
    const ivec3 count((down(box.max().x()) - first.x) / edge + 1,
                      (down(box.max().y()) - first.y) / edge + 1,
                      (down(box.max().z()) - first.z) / edge + 1);
    if (int64_t(count.x) * count.y * count.z > mostBricks) {
        problem = "the grid is too large";
        return nullptr;
    }
    const openvdb::Mat4R m = affine->getAffineMap()->getMat4();
    mat4 indexToObject; // OpenVDB's vectors are rows, so its rows are our columns
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            indexToObject[row][column] = float(m[row][column]);
    auto result = std::make_shared<FieldGrid>(first, count, components, indexToObject);
    auto accessor = grid.getConstAccessor();
    std::vector<float> values(size_t(FieldGrid::voxels) * components);
    ivec3 b;
    for (b.x = 0; b.x < count.x; ++b.x)
        for (b.y = 0; b.y < count.y; ++b.y)
            for (b.z = 0; b.z < count.z; ++b.z) {
                const Coord origin(first.x + b.x * edge, first.y + b.y * edge,
                                   first.z + b.z * edge);
                const auto* leaf = accessor.probeConstLeaf(origin);
                if (!leaf && !accessor.isValueOn(origin)) continue;
                const auto tile = leaf ? grid.background() : accessor.getValue(origin);
                for (int i = 0; i < FieldGrid::voxels; ++i) {
                    const bool on = !leaf || leaf->isValueOn(openvdb::Index(i));
                    for (int c = 0; c < components; ++c)
                        values[size_t(i) * components + c] =
                            !on    ? 0.0f
                            : leaf ? component(leaf->getValue(openvdb::Index(i)), c)
                                   : component(tile, c);
                }
                result->setBrick(b, values);
            }
    return result;
}

} // namespace

std::shared_ptr<const FieldGrid> readFieldGrid(const std::string& file, const std::string& field,
                                               const std::string& prim, Diagnostics& diagnostics) {
    static std::once_flag once;
    std::call_once(once, [] { openvdb::initialize(); });
    std::string problem;
    try {
        openvdb::io::File in(file);
        in.open();
        openvdb::GridBase::Ptr grid;
        std::shared_ptr<const FieldGrid> made;
        for (auto name = in.beginName(); name != in.endName(); ++name)
            if (name.gridName() == field) grid = in.readGrid(name.gridName());
        if (!grid)
            problem = "there is no grid of that name";
        else if (const auto* f = dynamic_cast<const openvdb::FloatGrid*>(grid.get()))
            made = copy(*f, 1, problem);
        else if (const auto* d = dynamic_cast<const openvdb::DoubleGrid*>(grid.get()))
            made = copy(*d, 1, problem);
        else if (const auto* v = dynamic_cast<const openvdb::Vec3SGrid*>(grid.get()))
            made = copy(*v, 3, problem);
        else if (const auto* w = dynamic_cast<const openvdb::Vec3DGrid*>(grid.get()))
            made = copy(*w, 3, problem);
        else
            problem = "the grid holds neither numbers nor vectors";
        if (made) return made;
    } catch (const std::exception& e) {
        problem = e.what();
    }
    diagnostics.warn(prim, "field",
                     "grid '" + field + "' of " + file + " cannot be read: " + problem);
    return nullptr;
}

#else

std::shared_ptr<const FieldGrid> readFieldGrid(const std::string& file, const std::string&,
                                               const std::string& prim, Diagnostics& diagnostics) {
    diagnostics.warn(prim, "field", file + " is not read: this build has no OpenVDB");
    return nullptr;
}

#endif

} // namespace patina

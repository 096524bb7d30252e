// SPDX-License-Identifier: Apache-2.0
// patinaReadField FILE GRID: writes a grid of an OpenVDB file to standard output (fieldStream.h).
// A program of its own, because OpenVDB aborts, overruns its memory or never ends on damaged files,
// and what happens here does not happen to the host. The only file that knows OpenVDB.
#include "hdDelegate/image/fieldReader/fieldStream.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace patina;

namespace {

constexpr int edge = fieldStreamEdge;

void put(const void* data, size_t bytes) {
    if (bytes && std::fwrite(data, 1, bytes, stdout) != bytes) ::_exit(3); // nobody reads any more
}

bool begun = false; ///< the header is written

void begin(const FieldStreamHeader& header) {
    put(&header, sizeof header);
    begun = true;
}

/// Ends the stream, early where bricks were already written.
void report(const std::string& problem) {
    if (!begun) begin({});
    FieldStreamBrick end;
    end.place[0] = -1;
    end.place[1] = int32_t(std::min<size_t>(problem.size(), fieldStreamText));
    put(&end, sizeof end);
    put(problem.data(), size_t(end.place[1]));
}

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

/// @returns what is wrong with the grid
template <class Grid> std::string write(const Grid& grid, int components) {
    using openvdb::Coord;
    const auto affine = grid.transform().baseMap();
    if (!affine || !affine->isLinear()) return "the grid's transform is not affine";
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) return "the grid is empty";
    FieldStreamHeader header;
    header.components = components;
    int64_t places = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (box.min()[axis] < -fieldStreamFar || box.max()[axis] > fieldStreamFar)
            return "the grid is too far from its origin";
        header.firstVoxel[axis] = box.min()[axis] & ~(edge - 1);
        header.brickCount[axis] = (box.max()[axis] - header.firstVoxel[axis]) / edge + 1;
        places *= header.brickCount[axis];
        if (places > fieldStreamPlaces) return "the grid is too large";
    }
    const openvdb::Mat4R m = affine->getAffineMap()->getMat4();
    for (int i = 0; i < 16; ++i) // OpenVDB's vectors are rows, so its rows are our columns
        header.indexToObject[i] = float(m[i / 4][i % 4]);
    begin(header);

    auto accessor = grid.getConstAccessor();
    std::vector<float> values(size_t(edge * edge * edge) * size_t(components));
    FieldStreamBrick b;
    const int32_t *first = header.firstVoxel, *count = header.brickCount;
    for (b.place[0] = 0; b.place[0] < count[0]; ++b.place[0])
        for (b.place[1] = 0; b.place[1] < count[1]; ++b.place[1])
            for (b.place[2] = 0; b.place[2] < count[2]; ++b.place[2]) {
                const Coord origin(first[0] + b.place[0] * edge, first[1] + b.place[1] * edge,
                                   first[2] + b.place[2] * edge);
                const auto* leaf = accessor.probeConstLeaf(origin);
                if (!leaf && !accessor.isValueOn(origin)) continue;
                const auto tile = leaf ? grid.background() : accessor.getValue(origin);
                for (int i = 0; i < edge * edge * edge; ++i) {
                    const bool on = !leaf || leaf->isValueOn(openvdb::Index(i));
                    for (int c = 0; c < components; ++c)
                        values[size_t(i * components + c)] =
                            !on    ? 0.0f
                            : leaf ? component(leaf->getValue(openvdb::Index(i)), c)
                                   : component(tile, c);
                }
                put(&b, sizeof b);
                put(values.data(), values.size() * sizeof(float));
            }
    return {};
}

std::string read(const std::string& file, const std::string& field) {
    openvdb::initialize();
    openvdb::io::File in(file);
    in.open();
    openvdb::GridBase::Ptr grid;
    for (auto name = in.beginName(); name != in.endName(); ++name)
        if (name.gridName() == field) grid = in.readGrid(name.gridName());
    if (!grid) return "there is no grid of that name";
    if (const auto* f = dynamic_cast<const openvdb::FloatGrid*>(grid.get())) return write(*f, 1);
    if (const auto* d = dynamic_cast<const openvdb::DoubleGrid*>(grid.get())) return write(*d, 1);
    if (const auto* v = dynamic_cast<const openvdb::Vec3SGrid*>(grid.get())) return write(*v, 3);
    if (const auto* w = dynamic_cast<const openvdb::Vec3DGrid*>(grid.get())) return write(*w, 3);
    return "the grid holds neither numbers nor vectors";
}

template <class Resource> void limit(Resource resource, rlim_t maximum) {
    rlimit now;
    if (::getrlimit(resource, &now) != 0) return;
    now.rlim_cur = std::min(now.rlim_max, maximum);
    ::setrlimit(resource, &now);
}

/// The most that a damaged file may ask for: half a GiB besides what the tightest packing
/// (deflate's, 1032:1) gives of the file, no more than the machine has, and ten seconds with one
/// more for each MiB.
void limitResources(const std::string& file) {
    struct stat found;
    const rlim_t bytes = ::stat(file.c_str(), &found) == 0 ? rlim_t(found.st_size) : 0;
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, 10 + (bytes >> 20));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // these map terabytes
    const long pages = ::sysconf(_SC_PHYS_PAGES), pageSize = ::sysconf(_SC_PAGESIZE);
    if (pages > 0 && pageSize > 0) {
        const rlim_t all = rlim_t(pages) * rlim_t(pageSize);
        limit(RLIMIT_AS, (rlim_t(1) << 29) + std::min(all, bytes * 1033));
    }
#endif
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: patinaReadField FILE GRID\nWrites a grid of an OpenVDB file to standard "
                   "output, as Patina reads it.\n",
                   stderr);
        return 2;
    }
    std::signal(SIGINT, SIG_IGN); // is for the host, which ends reading by going away
    limitResources(argv[1]);
    std::string problem;
    try {
        problem = read(argv[1], argv[2]);
    } catch (const std::bad_alloc&) {
        problem = "it asks for more memory than it can fill; it is damaged";
    } catch (const std::exception& e) {
        problem = e.what();
    }
    report(problem);
    // Without the destructors of a tree that may be damaged.
    const bool done = std::fflush(stdout) == 0;
    ::_exit(done ? 0 : 3);
}

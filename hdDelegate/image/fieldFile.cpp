// SPDX-License-Identifier: Apache-2.0
// Runs patinaReadField and takes what it writes.
#include "hdDelegate/image/fieldGrid.h"

#include "hdDelegate/image/fieldReader/fieldStream.h"
#include "base/limits.h"
#include "base/childProgram.h"
#include "base/regularFile.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace patina {

#ifdef PATINA_FIELD_READER

namespace {

static_assert(FieldGrid::edge == fieldStreamEdge, "bricks are passed on as they are");

/// The program that knows OpenVDB, whose output is read.
class Program {
public:
    Program(const std::string& file, const std::string& field) {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) fail(errno);
        try {
            _process = startProgram(programPath("patinaReadField", PATINA_FIELD_READER),
                                    {file, field}, -1, ends[1]);
        } catch (...) {
            ::close(ends[0]);
            ::close(ends[1]);
            throw;
        }
        ::close(ends[1]);
        _output = ::fdopen(ends[0], "rb");
        if (!_output) {
            const int error = errno;
            ::close(ends[0]);
            end();
            fail(error);
        }
    }
    ~Program() { end(); }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// @throws std::runtime_error when the program has ended before
    void read(void* data, size_t bytes) {
        if (bytes && std::fread(data, 1, bytes, _output) != bytes)
            throw std::runtime_error("OpenVDB failed on it" + end() + "; the file is damaged");
    }

private:
    [[noreturn]] static void fail(int error) {
        throw std::runtime_error("no program can be started to read it: " +
                                 std::string(std::strerror(error)));
    }

    /// @returns how the program ended, where that is known and not what it should be
    std::string end() {
        if (_output) std::fclose(_output);
        _output = nullptr;
        return endProgram(std::exchange(_process, -1));
    }

    pid_t _process = -1;
    FILE* _output = nullptr;
};

mat4 transformOf(const FieldStreamHeader& header) {
    mat4 m;
    std::memcpy(&m[0][0], header.indexToObject, sizeof header.indexToObject);
    const mat4 inverse = glm::inverse(m);
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(m[i / 4][i % 4]) || !std::isfinite(inverse[i / 4][i % 4]))
            throw std::runtime_error("the grid's transform cannot be inverted");
    return m;
}

std::shared_ptr<const FieldGrid> take(Program& program) {
    FieldStreamHeader header;
    const FieldStreamHeader ours;
    program.read(&header, sizeof header);
    int64_t places = 1;
    bool good = std::memcmp(header.magic, ours.magic, sizeof ours.magic) == 0 &&
                (header.components == 1 || header.components == 3);
    for (int axis = 0; axis < 3; ++axis) {
        places *= std::clamp<int64_t>(header.brickCount[axis], 0, fieldStreamPlaces);
        if (places > fieldStreamPlaces) places = fieldStreamPlaces + 1;
        good &= places <= fieldStreamPlaces && header.brickCount[axis] >= 0 &&
                std::abs(int64_t(header.firstVoxel[axis])) <= fieldStreamFar + fieldStreamEdge;
    }
    if (!good) throw std::runtime_error("the program that reads it is another than it should be");
    uint64_t held = 0;
    const auto hold = [&](uint64_t bytes) {
        held += bytes;
        if (held > limitOf(Limit::textureBytes))
            throw std::runtime_error("its voxels take more bytes than " +
                                     limitText(Limit::textureBytes));
    };
    hold(uint64_t(places) * sizeof(int));
    std::shared_ptr<FieldGrid> grid;
    if (places > 0)
        grid = std::make_shared<FieldGrid>(
            ivec3(header.firstVoxel[0], header.firstVoxel[1], header.firstVoxel[2]),
            ivec3(header.brickCount[0], header.brickCount[1], header.brickCount[2]),
            header.components, transformOf(header));
    std::vector<float> values(size_t(FieldGrid::voxels) * size_t(header.components));
    FieldStreamBrick brick;
    for (program.read(&brick, sizeof brick); brick.place[0] >= 0;
         program.read(&brick, sizeof brick)) {
        for (int axis = 0; axis < 3; ++axis)
            if (brick.place[axis] < 0 || brick.place[axis] >= header.brickCount[axis])
                throw std::runtime_error("a brick lies outside of the grid");
        program.read(values.data(), values.size() * sizeof(float));
        hold(values.size() * sizeof(float));
        grid->setBrick(ivec3(brick.place[0], brick.place[1], brick.place[2]), values);
    }
    std::string problem(size_t(std::clamp<int64_t>(brick.place[1], 0, fieldStreamText)), ' ');
    program.read(&problem[0], problem.size());
    if (!problem.empty()) throw std::runtime_error(problem);
    if (!grid) throw std::runtime_error("the grid is empty");
    return grid;
}

} // namespace

std::shared_ptr<const FieldGrid> readFieldGrid(const std::string& file, const std::string& field,
                                               const std::string& prim, Diagnostics& diagnostics) {
    std::string problem = whyUnreadable(file, Limit::imageBytes);
    if (problem.empty()) {
        try {
            Program program(file, field);
            return take(program);
        } catch (const std::bad_alloc&) {
            problem = "it takes more memory than there is";
        } catch (const std::exception& e) {
            problem = e.what();
        }
    } else {
        problem = "the file " + problem;
    }
    diagnostics.warn(prim, "field", messages::gridUnreadable(field, file, problem));
    return nullptr;
}

#else

std::shared_ptr<const FieldGrid> readFieldGrid(const std::string& file, const std::string&,
                                               const std::string& prim, Diagnostics& diagnostics) {
    diagnostics.warn(prim, "field", messages::openVdbMissing(file));
    return nullptr;
}

#endif

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace patina {

/// The standard output of patinaReadField, numbers as the machine has them:
///
///   FieldStreamHeader
///   bricks, each a FieldStreamBrick and its floats
///   the end: a FieldStreamBrick whose x is -1 and y the length of a problem, which follows
///
/// A stream without its end is cut. One that ends with a problem holds no grid.
struct FieldStreamHeader {
    char magic[8] = {'P', 'a', 't', 'F', 'i', 'e', 'l', 'd'};
    int32_t firstVoxel[3] = {}, brickCount[3] = {};
    int32_t components = 1; ///< 1 or 3
    float indexToObject[16] = {};
};

struct FieldStreamBrick {
    int32_t place[3] = {}; ///< counted from the first one
};

constexpr int fieldStreamEdge = 8;                      ///< voxels along each side of a brick
constexpr int64_t fieldStreamPlaces = int64_t(1) << 27; ///< the most that a grid's box holds
constexpr int32_t fieldStreamFar = 1 << 29;             ///< no voxel is further from the origin
constexpr uint32_t fieldStreamText = 1 << 16;           ///< the longest problem

} // namespace patina

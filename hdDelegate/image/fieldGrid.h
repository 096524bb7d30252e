// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"
#include "base/diagnostics.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// Values on a sparse grid: bricks of 8 x 8 x 8 voxels, zero where there is none. Voxel centres
/// have whole index coordinates, and values between them are interpolated linearly.
class FieldGrid {
public:
    static constexpr int edge = 8, voxels = edge * edge * edge;

    /// @param firstVoxel of the first brick, index coordinates
    /// @param brickCount bricks along each axis
    /// @param components 1 or 3
    FieldGrid(const ivec3& firstVoxel, const ivec3& brickCount, int components,
              const mat4& indexToObject);

    /// @param brick counted from the first one
    /// @param values x runs slowest and z fastest, as in OpenVDB's leaves; those that are not
    /// finite become 0
    void setBrick(const ivec3& brick, const std::vector<float>& values);

    int components() const { return _components; }
    const mat4& indexToObject() const { return _indexToObject; }
    /// Outside of this, in object space, all values are 0.
    vec3 boundsMin() const { return _boundsMin; }
    vec3 boundsMax() const { return _boundsMax; }
    ivec3 brickCount() const { return _count; }
    uint64_t bytes() const { return _bricks.size() * sizeof(int) + _values.size() * sizeof(float); }

    vec3 sample(const vec3& objectPosition) const;

    /// Widens a range by all values that interpolation can give in a box of object space.
    void range(const vec3& boxMin, const vec3& boxMax, vec3& minimum, vec3& maximum) const;

private:
    vec3 voxel(const ivec3& relative) const;

    ivec3 _first, _count;
    int _components;
    mat4 _indexToObject, _objectToIndex;
    vec3 _boundsMin, _boundsMax;
    std::vector<int> _bricks;             ///< per brick place: index of its values, -1 for none
    std::vector<float> _values;           ///< voxels * components per brick
    std::vector<vec3> _minimum, _maximum; ///< per brick with values
};

/// Reads a grid of an OpenVDB file. @returns null, after a warning, when that fails or this build
/// cannot read such files.
std::shared_ptr<const FieldGrid> readFieldGrid(const std::string& file, const std::string& field,
                                               const std::string& prim, Diagnostics& diagnostics);

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/fieldGrid.h"

#include <algorithm>
#include <cmath>

namespace patina {

FieldGrid::FieldGrid(const ivec3& firstVoxel, const ivec3& brickCount, int components,
                     const mat4& indexToObject)
    : _first(firstVoxel), _count(glm::max(brickCount, ivec3(0))), _components(components),
      _indexToObject(indexToObject), _objectToIndex(glm::inverse(indexToObject)),
      _boundsMin(INFINITY), _boundsMax(-INFINITY),
      _bricks(size_t(_count.x) * _count.y * _count.z, -1) {
    // Values fall to zero over one voxel outside.
    const vec3 lower = vec3(_first) - 1.0f, upper = vec3(_first + _count * edge);
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p((corner & 1) ? upper.x : lower.x, (corner & 2) ? upper.y : lower.y,
                     (corner & 4) ? upper.z : lower.z);
        const vec3 q = vec3(_indexToObject * vec4(p, 1.0f));
        _boundsMin = glm::min(_boundsMin, q);
        _boundsMax = glm::max(_boundsMax, q);
    }
}

void FieldGrid::setBrick(const ivec3& brick, const std::vector<float>& values) {
    vec3 minimum(INFINITY), maximum(-INFINITY);
    const size_t begin = _values.size();
    _values.resize(begin + size_t(voxels) * _components, 0.0f);
    for (size_t i = 0; i < size_t(voxels) * _components && i < values.size(); ++i)
        if (std::isfinite(values[i])) _values[begin + i] = values[i];
    for (int i = 0; i < voxels; ++i) {
        vec3 v(_values[begin + size_t(i) * _components]);
        for (int c = 1; c < _components; ++c)
            v[c] = _values[begin + size_t(i) * _components + c];
        minimum = glm::min(minimum, v);
        maximum = glm::max(maximum, v);
    }
    _bricks[(size_t(brick.x) * _count.y + brick.y) * _count.z + brick.z] = int(_minimum.size());
    _minimum.push_back(minimum);
    _maximum.push_back(maximum);
}

vec3 FieldGrid::voxel(const ivec3& p) const {
    if (p.x < 0 || p.y < 0 || p.z < 0) return vec3(0.0f);
    const ivec3 b(p.x / edge, p.y / edge, p.z / edge);
    if (b.x >= _count.x || b.y >= _count.y || b.z >= _count.z) return vec3(0.0f);
    const int brick = _bricks[(size_t(b.x) * _count.y + b.y) * _count.z + b.z];
    if (brick < 0) return vec3(0.0f);
    const size_t inside = (size_t(p.x % edge) * edge + p.y % edge) * edge + p.z % edge;
    const float* v = &_values[(size_t(brick) * voxels + inside) * _components];
    return _components == 1 ? vec3(v[0]) : vec3(v[0], v[1], v[2]);
}

vec3 FieldGrid::sample(const vec3& objectPosition) const {
    const vec3 p = vec3(_objectToIndex * vec4(objectPosition, 1.0f)) - vec3(_first);
    const vec3 limit = vec3(_count * edge);
    if (!(p.x > -1.0f && p.y > -1.0f && p.z > -1.0f && p.x < limit.x && p.y < limit.y &&
          p.z < limit.z))
        return vec3(0.0f);
    const vec3 low = glm::floor(p), f = p - low;
    const ivec3 i(low);
    vec3 sum(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const ivec3 d(corner & 1, corner >> 1 & 1, corner >> 2);
        const float w =
            (d.x ? f.x : 1.0f - f.x) * (d.y ? f.y : 1.0f - f.y) * (d.z ? f.z : 1.0f - f.z);
        if (w > 0.0f) sum += w * voxel(i + d);
    }
    return sum;
}

void FieldGrid::range(const vec3& boxMin, const vec3& boxMax, vec3& minimum, vec3& maximum) const {
    vec3 lower(INFINITY), upper(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p((corner & 1) ? boxMax.x : boxMin.x, (corner & 2) ? boxMax.y : boxMin.y,
                     (corner & 4) ? boxMax.z : boxMin.z);
        const vec3 q = vec3(_objectToIndex * vec4(p, 1.0f)) - vec3(_first);
        lower = glm::min(lower, q);
        upper = glm::max(upper, q);
    }
    // In bricks, with the neighbours that interpolation reads; clamped before they are whole.
    const auto toBrick = [&](const vec3& p) {
        return ivec3(glm::floor(glm::clamp(p / float(edge), vec3(-1.0f), vec3(_count))));
    };
    const ivec3 a = toBrick(lower - 1.01f), b = toBrick(upper + 1.01f);
    for (int x = a.x; x <= b.x; ++x)
        for (int y = a.y; y <= b.y; ++y)
            for (int z = a.z; z <= b.z; ++z) {
                const bool inside =
                    x >= 0 && y >= 0 && z >= 0 && x < _count.x && y < _count.y && z < _count.z;
                const int brick = inside ? _bricks[(size_t(x) * _count.y + y) * _count.z + z] : -1;
                minimum = glm::min(minimum, brick < 0 ? vec3(0.0f) : _minimum[size_t(brick)]);
                maximum = glm::max(maximum, brick < 0 ? vec3(0.0f) : _maximum[size_t(brick)]);
            }
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sharing/sharedLight.h"

#include "hdDelegate/parallel.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float leastWidth = 1e-20f;

/// The cell of a place, the axis that its surface faces most, and the depth; never 0.
uint64_t keyOf(const SharedPoint& point, const vec3& place, float size) {
    // Flat surfaces often lie where cells would border on each other.
    const vec3 cell = glm::floor((place + point.normal * (0.05f * size)) / size);
    const vec3 a = glm::abs(point.normal);
    const int axis = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;
    uint64_t key = uint64_t(2 * axis + (point.normal[axis] < 0.0f ? 1 : 2));
    key = key << 4 | uint64_t(std::min(point.depth, 15));
    for (int i = 0; i < 3; ++i) // cells as far apart as 2^19 of them do not meet
        key = key << 19 | (uint64_t(int64_t(std::clamp(cell[i], -1e9f, 1e9f))) & 0x7ffff);
    return key;
}

} // namespace

size_t SharedLight::Level::placeOf(uint64_t key) const {
    uint64_t hash = key * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
    size_t place = size_t(hash) & (_cells.size() - 1);
    while (_cells[place].key != 0 && _cells[place].key != key)
        place = (place + 1) & (_cells.size() - 1);
    return place;
}

void SharedLight::Level::add(const SharedPoint& point, float size) {
    if (2 * _count >= _cells.size()) {
        std::vector<Cell> cells(2 * _cells.size());
        cells.swap(_cells);
        for (const Cell& cell : cells)
            if (cell.key != 0) _cells[placeOf(cell.key)] = cell;
    }
    const uint64_t key = keyOf(point, point.position, size);
    Cell& cell = _cells[placeOf(key)];
    if (cell.key == 0) ++_count;
    cell.key = key;
    cell.sum += point.light;
    ++cell.count;
}

const SharedLight::Cell& SharedLight::Level::at(const SharedPoint& point, float size,
                                                const vec2& u) const {
    vec3 tangent, bitangent;
    orthonormalBasis(point.normal, tangent, bitangent);
    const vec3 moved = tangent * (u.x - 0.5f) + bitangent * (u.y - 0.5f);
    return _cells[placeOf(keyOf(point, point.position + size * moved, size))];
}

int SharedLight::levelOf(const SharedPoint& point) const {
    if (!(point.width > leastWidth)) return -1;
    return int(std::floor(std::log2(_scale * point.width))) - _finest;
}

float SharedLight::sizeOf(int level) const {
    return std::ldexp(1.0f, _finest + level);
}

SharedLight::SharedLight(const std::vector<SharedPoint>& points, float scale) : _scale(scale) {
    std::vector<float> widths;
    for (const SharedPoint& p : points)
        if (p.width > leastWidth) widths.push_back(p.width);
    if (widths.empty()) return;
    // Few cones are wider, and few of those would have wider cells.
    const auto widest = widths.begin() + long(widths.size() * 9 / 10);
    std::nth_element(widths.begin(), widest, widths.end());
    _finest = int(std::floor(std::log2(_scale * *widest))) - levelCount + 1;
    _levels.resize(levelCount);
    parallelFor(0, levelCount, [&](int level) {
        for (const SharedPoint& p : points)
            if (levelOf(p) >= level) _levels[size_t(level)].add(p, sizeOf(level));
    });
}

bool SharedLight::find(const SharedPoint& at, const vec2& u, vec3& light) const {
    if (_levels.empty()) return false;
    const auto cellOf = [&](int level) -> const Cell& {
        return _levels[size_t(level)].at(at, sizeOf(level), u);
    };
    const int most = std::min(levelOf(at), levelCount - 1);
    if (most < 0) return false;
    const Cell* cell = &cellOf(most);
    if (cell->count < least) return false;
    // Of a surface, a cell half as wide has a quarter of the points.
    const int halvings = int(0.5f * std::log2(float(cell->count) / float(wanted)));
    if (halvings > 0) {
        const Cell& inner = cellOf(std::max(most - halvings, 0));
        if (inner.count >= least) cell = &inner;
    }
    light = cell->sum / float(cell->count);
    return true;
}

} // namespace patina

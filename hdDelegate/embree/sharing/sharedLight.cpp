// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sharing/sharedLight.h"

#include "hdDelegate/parallel.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina {

namespace {

constexpr float leastWidth = 1e-20f, mostWidth = 1e30f; // of cones

/// One of 54 parts of the sphere: three by three of each side of a cube.
uint64_t partOf(const vec3& normal) {
    const vec3 a = glm::abs(normal);
    const int axis = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;
    const auto third = [&](int i) {
        return std::clamp(int(1.5f * (normal[i % 3] / a[axis] + 1.0f)), 0, 2);
    };
    return uint64_t(((2 * axis + (normal[axis] < 0.0f ? 1 : 0)) * 3 + third(axis + 1)) * 3 +
                    third(axis + 2));
}

/// The cell of a place, and the direction and the depth; never 0.
uint64_t keyOf(const SharedPoint& point, const vec3& place, float size) {
    // Flat surfaces often lie where cells would border on each other.
    const vec3 cell = glm::floor((place + point.side * (0.05f * size)) / size);
    uint64_t key = partOf(point.normal) << 4 | uint64_t(point.depth + 1);
    for (int i = 0; i < 3; ++i) // cells as far apart as 2^18 of them do not meet
        key = key << 18 | (uint64_t(int64_t(std::clamp(cell[i], -1e9f, 1e9f))) & 0x3ffff);
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

void SharedLight::Level::add(const std::vector<SharedPoint>& points,
                             const std::vector<uint32_t>& which, float size) {
    std::vector<std::pair<uint64_t, uint32_t>> keys;
    keys.reserve(which.size());
    for (const uint32_t i : which)
        keys.emplace_back(keyOf(points[i], points[i].position, size), i);
    std::sort(keys.begin(), keys.end());
    std::vector<Cell> cells;
    for (size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
        Cell cell{keys[begin].first};
        for (; end < keys.size() && keys[end].first == cell.key; ++end, ++cell.count)
            cell.sum += points[keys[end].second].light;
        if (cell.count >= least) cells.push_back(cell);
    }
    size_t room = 1;
    while (room < 2 * cells.size())
        room *= 2;
    _cells.assign(room, Cell());
    for (const Cell& cell : cells)
        _cells[placeOf(cell.key)] = cell;
}

const SharedLight::Cell& SharedLight::Level::at(const SharedPoint& point, float size,
                                                const vec2& u) const {
    vec3 tangent, bitangent;
    orthonormalBasis(point.side, tangent, bitangent);
    const vec3 moved = tangent * (u.x - 0.5f) + bitangent * (u.y - 0.5f);
    return _cells[placeOf(keyOf(point, point.position + size * moved, size))];
}

int SharedLight::levelOf(const SharedPoint& point) const {
    const vec3 place = point.position + point.side + point.normal;
    if (!(point.width > leastWidth) || point.depth > SharedPoint::mostDepth ||
        !std::isfinite(place.x + place.y + place.z) || point.normal == vec3(0.0f))
        return -1;
    return int(std::floor(std::log2(_scale * std::min(point.width, mostWidth)))) - _finest;
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
    _finest = int(std::floor(std::log2(_scale * std::min(*widest, mostWidth)))) - levelCount + 1;
    _levels.resize(levelCount);
    parallelFor(0, levelCount, [&](int level) {
        std::vector<uint32_t> which;
        for (size_t i = 0; i < points.size(); ++i)
            if (levelOf(points[i]) >= level) which.push_back(uint32_t(i));
        _levels[size_t(level)].add(points, which, sizeOf(level));
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
    if (cell->count == 0) return false;
    // Of a surface, a cell half as wide has a quarter of the points.
    const int halvings = int(0.5f * std::log2(float(cell->count) / float(wanted)));
    if (halvings > 0) {
        const Cell& inner = cellOf(std::max(most - halvings, 0));
        if (inner.count > 0) cell = &inner;
    }
    light = cell->sum / float(cell->count);
    return true;
}

} // namespace patina

#include "hdDelegate/lights/distribution2d.h"

#include <algorithm>

namespace patina {

namespace {

/// Finds the interval of a cumulative sum that u lies in; intervals of no width are never found.
int find(const float* cumulative, int count, float u, float& within) {
    const float* above = std::upper_bound(cumulative, cumulative + count + 1, u);
    int index = std::clamp(int(above - cumulative) - 1, 0, count - 1);
    while (index > 0 && !(cumulative[index + 1] > cumulative[index]))
        --index;
    const float width = cumulative[index + 1] - cumulative[index];
    within =
        width > 0.0f ? std::clamp((u - cumulative[index]) / width, 0.0f, 0x1.fffffep-1f) : 0.5f;
    return index;
}

/// Writes cumulative sums of `count` weights, from 0 to exactly 1. @returns the sum
template <class Weight> double accumulate(int count, const Weight& weight, float* cumulative) {
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += weight(i);
    double running = 0.0;
    cumulative[0] = 0.0f;
    for (int i = 0; i < count; ++i) {
        running += weight(i);
        cumulative[i + 1] = sum > 0.0 ? float(running / sum) : 0.0f;
    }
    if (sum > 0.0) cumulative[count] = 1.0f;
    return sum;
}

} // namespace

Distribution2d::Distribution2d(int width, int height, const std::vector<float>& weights)
    : _width(width), _height(height), _rows(size_t(height) + 1),
      _columns(size_t(width + 1) * size_t(height)) {
    std::vector<double> rowSums(height);
    for (int y = 0; y < height; ++y) {
        const float* row = &weights[size_t(y) * size_t(width)];
        rowSums[y] = accumulate(
            width, [row](int x) { return double(row[x]); },
            &_columns[size_t(y) * size_t(width + 1)]);
    }
    _total = accumulate(
        height, [&](int y) { return rowSums[y]; }, _rows.data());
}

float Distribution2d::sample(const glm::vec2& u, glm::ivec2& cell, glm::vec2& within) const {
    cell.y = find(_rows.data(), _height, u.y, within.y);
    cell.x = find(&_columns[size_t(cell.y) * size_t(_width + 1)], _width, u.x, within.x);
    return probability(cell);
}

float Distribution2d::probability(const glm::ivec2& cell) const {
    const float* row = &_columns[size_t(cell.y) * size_t(_width + 1)];
    return (_rows[cell.y + 1] - _rows[cell.y]) * (row[cell.x + 1] - row[cell.x]);
}

} // namespace patina

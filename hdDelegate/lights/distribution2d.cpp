// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/distribution2d.h"

#include "hdDelegate/lights/cumulative.h"

namespace patina {

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
    cell.y = invert(_rows.data(), _height, u.y, within.y);
    cell.x = invert(&_columns[size_t(cell.y) * size_t(_width + 1)], _width, u.x, within.x);
    return probability(cell);
}

float Distribution2d::probability(const glm::ivec2& cell) const {
    const float* row = &_columns[size_t(cell.y) * size_t(_width + 1)];
    return (_rows[cell.y + 1] - _rows[cell.y]) * (row[cell.x + 1] - row[cell.x]);
}

} // namespace patina

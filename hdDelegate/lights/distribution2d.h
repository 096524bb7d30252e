// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace patina {

/// A density that is constant in each cell of a grid over the unit square, sampled by inverting
/// cumulative sums: rows first, then within the row.
class Distribution2d {
public:
    Distribution2d() = default;
    /// @param weights row by row, not negative; they need not sum to anything
    Distribution2d(int width, int height, const std::vector<float>& weights);

    bool empty() const { return _total <= 0.0; } ///< all weights are 0
    int width() const { return _width; }
    int height() const { return _height; }
    double total() const { return _total; }

    /// @returns the probability of the cell; `cell` its column and row, `within` where in it
    float sample(const glm::vec2& u, glm::ivec2& cell, glm::vec2& within) const;
    float probability(const glm::ivec2& cell) const;

private:
    int _width = 0, _height = 0;
    double _total = 0.0;
    std::vector<float> _rows;    ///< cumulative, height + 1
    std::vector<float> _columns; ///< cumulative per row, width + 1 each
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace patina {

/// A density over the cells of a latlong grid, in proportion to the worth of a cell times the
/// cosine at a surface. So few samples of a sky lie below the horizon.
///
/// The grid is cut into blocks, at most 32 x 16. For each of a number of normals a table holds the
/// sums of the products per block. Within a block cells are chosen by worth alone. All choices
/// invert cumulative sums, rows first, so evenly spread numbers give evenly spread samples. A
/// fiftieth of the samples follows worth alone, because a lobe may have another normal than the
/// surface.
class SkyDistribution {
public:
    SkyDistribution() = default;
    /// @param weights of the cells, row by row from the pole +y, as of EnvironmentMap; not negative
    SkyDistribution(int width, int height, const std::vector<float>& weights);

    bool empty() const { return !_any; } ///< all weights are 0
    int width() const { return _width; }
    int height() const { return _height; }

    /// A sample whose row of cells in a block is chosen. The rest of the row that is to be read is
    /// on its way into the cache.
    struct Draw {
        const float* cells = nullptr; ///< cumulative
        int left = 0, count = 0;      ///< first column, number of cells
        int row = 0;
        float u = 0.0f, withinRow = 0.0f;
        float chance = 0.0f; ///< of the row in the block
    };
    /// @param normal unit, in the grid's frame; zero: by the weights alone
    /// @param twoSided light from below counts as much as from above
    Draw begin(const glm::vec2& u, const glm::vec3& normal, bool twoSided) const;
    /// @returns the probability of the cell; `cell` its column and row, `within` where in it
    float sample(const Draw& draw, glm::ivec2& cell, glm::vec2& within) const;
    float sample(const glm::vec2& u, const glm::vec3& normal, bool twoSided, glm::ivec2& cell,
                 glm::vec2& within) const {
        return sample(begin(u, normal, twoSided), cell, within);
    }
    float probability(const glm::ivec2& cell, const glm::vec3& normal, bool twoSided) const;
    /// Asks for the part of probability() that does not hang on the normal, which lies far apart.
    void fetch(const glm::ivec2& cell) const;

private:
    struct Part;

    std::vector<Part> parts(const std::vector<float>& weights) const;
    void fillBlocks(const std::vector<float>& weights);
    void fillTable(const std::vector<double>& products, float* table) const;
    const float* table(const glm::vec3& normal, bool twoSided) const;
    /// Where the cumulative sums of a block's rows begin, and those of a row's cells in it.
    size_t blockRows(const glm::ivec2& block) const;
    size_t rowCells(int row, int blockColumn) const;

    int _width = 0, _height = 0;
    bool _any = false;
    std::vector<int> _left, _top;  ///< first cells of the blocks, and the end
    std::vector<int> _columnBlock; ///< of a cell's column
    std::vector<int> _rowBlock;
    std::vector<float> _blockRows, _rowCells; ///< cumulative, from 0 to 1 each
    std::vector<float> _tables; ///< the first without a normal, then one- and two-sided ones
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/skyDistribution.h"

#include "hdDelegate/lights/cumulative.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace patina {

namespace {
constexpr int maxColumns = 32, maxRows = 16; ///< of blocks
constexpr int partsAcross = 4;               ///< of a block, each with a cosine of its own
constexpr int normalsAcross = 16;            ///< octahedral map
constexpr int normalCount = normalsAcross * normalsAcross;
constexpr double plainShare = 0.02;

/// Octahedral map of the unit square (Meyer et al. 2010).
glm::dvec3 octahedral(double u, double v) {
    const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0, z = 1.0 - std::abs(x) - std::abs(y);
    const glm::dvec3 n = z >= 0.0 ? glm::dvec3(x, y, z)
                                  : glm::dvec3(std::copysign(1.0 - std::abs(y), x),
                                               std::copysign(1.0 - std::abs(x), y), z);
    return glm::normalize(n);
}

int normalIndex(const glm::vec3& n) {
    const float scale = 1.0f / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    float x = n.x * scale, y = n.y * scale;
    if (n.z < 0.0f) {
        const float folded = std::copysign(1.0f - std::abs(y), x);
        y = std::copysign(1.0f - std::abs(x), y);
        x = folded;
    }
    const auto along = [](float v) {
        return std::clamp(int((0.5f * v + 0.5f) * normalsAcross), 0, normalsAcross - 1);
    };
    return along(y) * normalsAcross + along(x);
}

/// Cuts `cells` into `blocks` of about the same size.
void cut(int cells, int blocks, std::vector<int>& first, std::vector<int>& blockOf) {
    first.resize(size_t(blocks) + 1);
    for (int b = 0; b <= blocks; ++b)
        first[size_t(b)] = int((int64_t(b) * cells + blocks - 1) / blocks);
    blockOf.resize(size_t(cells));
    for (int b = 0; b < blocks; ++b)
        std::fill(blockOf.begin() + first[size_t(b)], blockOf.begin() + first[size_t(b) + 1], b);
}

} // namespace

/// A part of a block: where it lies, and what it is worth.
struct SkyDistribution::Part {
    int block;
    glm::vec3 direction;
    double weight;
};

SkyDistribution::SkyDistribution(int width, int height, const std::vector<float>& weights)
    : _width(width), _height(height) {
    cut(width, std::min(width, maxColumns), _left, _columnBlock);
    cut(height, std::min(height, maxRows), _top, _rowBlock);
    fillBlocks(weights);
    const int columns = int(_left.size()) - 1, rows = int(_top.size()) - 1;
    const size_t blocks = size_t(columns) * size_t(rows);
    const size_t stride = size_t(rows) + 1 + size_t(columns + 1) * size_t(rows);
    const std::vector<Part> all = parts(weights);
    std::vector<double> plain(blocks, 0.0);
    double sum = 0.0;
    for (const Part& part : all) {
        plain[size_t(part.block)] += part.weight;
        sum += part.weight;
    }
    _any = sum > 0.0;
    if (!_any) return;
    _tables.resize(stride * size_t(1 + 2 * normalCount));
    fillTable(plain, &_tables[0]);
    std::vector<double> above(blocks), around(blocks);
    for (int k = 0; k < normalCount; ++k) {
        glm::vec3 normals[4];
        for (int i = 0; i < 4; ++i)
            normals[i] = octahedral((k % normalsAcross + 0.25 + 0.5 * (i % 2)) / normalsAcross,
                                    (k / normalsAcross + 0.25 + 0.5 * (i / 2)) / normalsAcross);
        std::fill(above.begin(), above.end(), 0.0);
        std::fill(around.begin(), around.end(), 0.0);
        double sumAbove = 0.0, sumAround = 0.0;
        for (const Part& part : all) {
            float up = 0.0f, both = 0.0f;
            for (const glm::vec3& normal : normals) {
                const float cosine = glm::dot(normal, part.direction);
                up += std::max(cosine, 0.0f);
                both += std::abs(cosine);
            }
            above[size_t(part.block)] += part.weight * double(up);
            around[size_t(part.block)] += part.weight * double(both);
            sumAbove += part.weight * double(up);
            sumAround += part.weight * double(both);
        }
        for (size_t b = 0; b < blocks; ++b) {
            const double worth = plain[b] / sum;
            const auto mixed = [worth](double product, double total) {
                return total > 0.0 ? plainShare * worth + (1.0 - plainShare) * product / total
                                   : worth;
            };
            above[b] = mixed(above[b], sumAbove);
            around[b] = mixed(around[b], sumAround);
        }
        fillTable(above, &_tables[stride * size_t(1 + k)]);
        fillTable(around, &_tables[stride * size_t(1 + normalCount + k)]);
    }
}

std::vector<SkyDistribution::Part> SkyDistribution::parts(const std::vector<float>& weights) const {
    std::vector<Part> result;
    const int columns = int(_left.size()) - 1, rows = int(_top.size()) - 1;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const int x0 = _left[size_t(column)], wide = _left[size_t(column) + 1] - x0;
            const int y0 = _top[size_t(row)], high = _top[size_t(row) + 1] - y0;
            const int across = std::min(wide, partsAcross), down = std::min(high, partsAcross);
            for (int j = 0; j < down; ++j)
                for (int i = 0; i < across; ++i) {
                    const int xa = x0 + i * wide / across, xb = x0 + (i + 1) * wide / across;
                    const int ya = y0 + j * high / down, yb = y0 + (j + 1) * high / down;
                    double weight = 0.0;
                    for (int y = ya; y < yb; ++y)
                        for (int x = xa; x < xb; ++x)
                            weight += weights[size_t(y) * size_t(_width) + size_t(x)];
                    if (!(weight > 0.0)) continue;
                    const double longitude = (1.0 - double(xa + xb) / _width) * piDouble;
                    const double theta = 0.5 * double(ya + yb) / _height * piDouble;
                    const double sine = std::sin(theta);
                    result.push_back({row * columns + column,
                                      glm::vec3(sine * std::sin(longitude), std::cos(theta),
                                                sine * std::cos(longitude)),
                                      weight});
                }
        }
    return result;
}

void SkyDistribution::fillBlocks(const std::vector<float>& weights) {
    const int columns = int(_left.size()) - 1, rows = int(_top.size()) - 1;
    _rowCells.resize(size_t(_width + columns) * size_t(_height));
    _blockRows.resize(size_t(_height + rows) * size_t(columns));
    std::vector<double> sums(size_t(_height), 0.0);
    for (int column = 0; column < columns; ++column) {
        const int x0 = _left[size_t(column)], wide = _left[size_t(column) + 1] - x0;
        for (int y = 0; y < _height; ++y) {
            const float* row = &weights[size_t(y) * size_t(_width) + size_t(x0)];
            sums[size_t(y)] = accumulate(
                wide, [row](int x) { return double(row[x]); }, &_rowCells[rowCells(y, column)]);
        }
        for (int r = 0; r < rows; ++r) {
            const int y0 = _top[size_t(r)];
            accumulate(
                _top[size_t(r) + 1] - y0, [&](int y) { return sums[size_t(y0 + y)]; },
                &_blockRows[blockRows({column, r})]);
        }
    }
}

void SkyDistribution::fillTable(const std::vector<double>& products, float* table) const {
    const int columns = int(_left.size()) - 1, rows = int(_top.size()) - 1;
    std::vector<double> sums(size_t(rows), 0.0);
    for (int r = 0; r < rows; ++r)
        sums[size_t(r)] = accumulate(
            columns, [&](int c) { return products[size_t(r * columns + c)]; },
            table + rows + 1 + r * (columns + 1));
    accumulate(
        rows, [&](int r) { return sums[size_t(r)]; }, table);
}

size_t SkyDistribution::blockRows(const glm::ivec2& block) const {
    const size_t rows = _top.size() - 1;
    return size_t(block.x) * (size_t(_height) + rows) + size_t(_top[size_t(block.y)] + block.y);
}

size_t SkyDistribution::rowCells(int row, int blockColumn) const {
    const size_t columns = _left.size() - 1;
    return size_t(row) * (size_t(_width) + columns) +
           size_t(_left[size_t(blockColumn)] + blockColumn);
}

const float* SkyDistribution::table(const glm::vec3& normal, bool twoSided) const {
    const float squared =
        glm::dot(normal, normal); // broken geometry has normals that are no numbers
    if (!(squared > 0.0f && std::isfinite(squared))) return &_tables[0];
    const size_t columns = _left.size() - 1, rows = _top.size() - 1;
    return &_tables[(rows + 1 + (columns + 1) * rows) *
                    size_t(1 + (twoSided ? normalCount : 0) + normalIndex(normal))];
}

SkyDistribution::Draw SkyDistribution::begin(const glm::vec2& u, const glm::vec3& normal,
                                             bool twoSided) const {
    const int columns = int(_left.size()) - 1, rows = int(_top.size()) - 1;
    const float* blocks = table(normal, twoSided);
    Draw draw;
    glm::ivec2 block;
    float v;
    block.y = invert(blocks, rows, u.y, v);
    draw.chance = blocks[block.y + 1] - blocks[block.y];
    blocks += rows + 1 + block.y * (columns + 1);
    block.x = invert(blocks, columns, u.x, draw.u);
    draw.chance *= blocks[block.x + 1] - blocks[block.x];
    const int top = _top[size_t(block.y)];
    const float* cellRows = &_blockRows[blockRows(block)];
    const int y = invert(cellRows, _top[size_t(block.y) + 1] - top, v, draw.withinRow);
    draw.chance *= cellRows[y + 1] - cellRows[y];
    draw.row = top + y;
    draw.left = _left[size_t(block.x)];
    draw.count = _left[size_t(block.x) + 1] - draw.left;
    draw.cells = &_rowCells[rowCells(draw.row, block.x)];
    constexpr int cacheLine = 16, maxLines = 5; // longer rows are searched by halves
    for (int i = 0; i <= std::min(draw.count, maxLines * cacheLine); i += cacheLine)
        __builtin_prefetch(draw.cells + i);
    return draw;
}

float SkyDistribution::sample(const Draw& draw, glm::ivec2& cell, glm::vec2& within) const {
    const int x = invert(draw.cells, draw.count, draw.u, within.x);
    cell = {draw.left + x, draw.row};
    within.y = draw.withinRow;
    return draw.chance * (draw.cells[x + 1] - draw.cells[x]);
}

float SkyDistribution::probability(const glm::ivec2& cell, const glm::vec3& normal,
                                   bool twoSided) const {
    const int columns = int(_left.size()) - 1, rows = int(_top.size()) - 1;
    const glm::ivec2 block(_columnBlock[size_t(cell.x)], _rowBlock[size_t(cell.y)]);
    const float* blocks = table(normal, twoSided);
    const float inRow = blocks[block.y + 1] - blocks[block.y];
    blocks += rows + 1 + block.y * (columns + 1);
    const float* cellRows = &_blockRows[blockRows(block) + size_t(cell.y - _top[size_t(block.y)])];
    const float* cells =
        &_rowCells[rowCells(cell.y, block.x) + size_t(cell.x - _left[size_t(block.x)])];
    return inRow * (blocks[block.x + 1] - blocks[block.x]) * (cellRows[1] - cellRows[0]) *
           (cells[1] - cells[0]);
}

void SkyDistribution::fetch(const glm::ivec2& cell) const {
    const int column = _columnBlock[size_t(cell.x)];
    const float* cells =
        &_rowCells[rowCells(cell.y, column) + size_t(cell.x - _left[size_t(column)])];
    __builtin_prefetch(cells);
    __builtin_prefetch(cells + 1);
}

} // namespace patina

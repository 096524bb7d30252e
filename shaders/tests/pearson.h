// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace patina::test {

/// Upper tail of the chi-squared distribution (Abramowitz and Stegun 1964, 26.4.4 and 26.4.5).
inline double chiSquaredTail(double x, int freedom) {
    const double y = 0.5 * x;
    if (y <= 0.0) return 1.0;
    const double first = 0.5 * (freedom % 2);
    double sum = freedom % 2 ? std::erfc(std::sqrt(y)) : 0.0;
    for (int i = 0; i < freedom / 2; ++i)
        sum += std::exp((first + i) * std::log(y) - y - std::lgamma(first + i + 1.0));
    return sum;
}

/// Bins of equal solid angle of the directions whose cosine with z is above `low`.
struct DirectionBins {
    int rows, columns;
    double low;

    std::size_t of(const glm::dvec3& w) const {
        const double turn = std::atan2(w.y, w.x) / (2.0 * M_PI) + 0.5;
        const int row = int((w.z - low) / (1.0 - low) * rows), column = int(turn * columns);
        return std::size_t(std::min(row, rows - 1) * columns + std::min(column, columns - 1));
    }
    /// Of a density over each, by fine x fine midpoints.
    template <class Density> std::vector<double> integrals(int fine, const Density& density) const {
        std::vector<double> all(std::size_t(rows * columns), 0.0);
        for (int r = 0; r < rows * fine; ++r)
            for (int c = 0; c < columns * fine; ++c) {
                const double z = low + (1.0 - low) * (r + 0.5) / (rows * fine);
                const double s = std::sqrt(1.0 - z * z);
                const double phi = 2.0 * M_PI * ((c + 0.5) / (columns * fine) - 0.5);
                all[std::size_t(r / fine * columns + c / fine)] +=
                    density(glm::vec3(s * std::cos(phi), s * std::sin(phi), z)) * 2.0 * M_PI *
                    (1.0 - low) / (double(rows) * columns * fine * fine);
            }
        return all;
    }
};

/// Pearson's chi-squared test, cell by cell.
class Pearson {
public:
    void add(double expected, double found) {
        _statistic += (found - expected) * (found - expected) / expected;
        ++_cells;
    }
    int cells() const { return _cells; }
    /// Chance of counts at least as far off.
    double tail() const { return _cells > 1 ? chiSquaredTail(_statistic, _cells - 1) : 1.0; }

private:
    double _statistic = 0.0;
    int _cells = 0;
};

/// Cells that expect less than `least` are one, which counts where it expects 5.
template <class Expected, class Found>
Pearson pearson(const Expected& expected, const Found& found, double least) {
    Pearson result;
    double pooledExpected = 0.0, pooledFound = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (expected[i] < least) {
            pooledExpected += expected[i];
            pooledFound += found[i];
        } else {
            result.add(expected[i], found[i]);
        }
    if (pooledExpected >= 5.0) result.add(pooledExpected, pooledFound);
    return result;
}

} // namespace patina::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

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

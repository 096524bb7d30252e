// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace patina::measure {

void Errors::add(double e) {
    count(e);
    for (size_t i = 0; i < _errors.size(); ++i) {
        _errors[i] += std::fabs(e);
        _truths[i] += 1.0;
        _counts[i] += 1.0;
    }
}

void Errors::add(double e, double truth, double place, double cosine, double sigma) {
    count(e);
    const auto cell = [](double x, int n) { return std::clamp(int(x * n), 0, n - 1); };
    for (int bin = 0; bin < binCount; ++bin) {
        if (place >= 0.0 && bin != cell(place, binCount)) continue;
        const size_t i = size_t(bin * cosineCount + cell(cosine, cosineCount));
        _errors[i] += std::fabs(e);
        _squared[i] += e * e;
        _noise[i] += sigma * sigma;
        _truths[i] += truth;
        _counts[i] += 1.0;
    }
}

void Errors::count(double e) {
    _sum += std::fabs(e);
    _squares += e * e;
    _largest = std::max(_largest, std::fabs(e));
    ++_count;
}

void Errors::into(Row& row) const {
    const double n = std::max(_count, 1);
    row.mean = _sum / n;
    row.rms = std::sqrt(_squares / n);
    row.largest = _largest;
    for (size_t i = 0; i < _errors.size(); ++i) {
        const double n = std::max(_counts[i], 1.0);
        // Of a truth with noise, what the noise explains is taken off the mean square.
        row.errors[i] =
            float(_noise[i] > 0.0 ? std::sqrt(std::max(_squared[i] - _noise[i], 0.0) / n)
                                  : _errors[i] / n);
        row.truths[i] = float(_truths[i] / n);
    }
}

void time(const std::function<double(int)>& batch, int evaluations, Row& row) {
    constexpr int batchCount = 31;
    constexpr double batchSeconds = 3e-4;
    volatile double kept = 0.0;
    const auto seconds = [&](int repeats) {
        const std::clock_t start = std::clock(); // of the process: others are not counted
        double sum = 0.0;
        for (int i = 0; i < repeats; ++i)
            sum += batch(evaluations);
        kept = kept + sum;
        return double(std::clock() - start) / CLOCKS_PER_SEC;
    };
    // Warms up, and finds how many repeats the clock can tell apart.
    const int repeats = int(std::clamp(batchSeconds / std::max(seconds(1), 1e-9), 1.0, 1000.0));
    std::vector<double> ns(batchCount);
    for (double& t : ns)
        t = seconds(repeats) * 1e9 / (double(repeats) * evaluations);
    std::sort(ns.begin(), ns.end());
    row.ns = ns[batchCount / 2];
    row.nsLow = ns[batchCount / 4];
    row.nsHigh = ns[3 * batchCount / 4];
}

std::vector<Row> measureMethods(const std::string& point, bool timed) {
    const struct {
        const char* name;
        std::vector<Row> (*measure)(bool);
    } points[] = {
#define PATINA_MEASURED(point) {#point, point},
#include "shaders/measuredPoints.inc"
#undef PATINA_MEASURED
    };
    std::vector<Row> rows;
    for (const auto& p : points)
        if (point.empty() || point == p.name)
            for (Row& row : p.measure(timed))
                rows.push_back(row);
    return rows;
}

} // namespace patina::measure

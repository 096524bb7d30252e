// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace patina::measure {

/// Cells of a row: errors are kept by what the method's quality hangs on, and by the cosine of the
/// view, so that a method is chosen where it is good.
constexpr int binCount = 8;    ///< along Row::axis
constexpr int cosineCount = 4; ///< quarters of [0, 1], grazing first
using Cells = std::array<float, binCount * cosineCount>;

/// One method at a choice point, on one subject: what it costs and how far it is off.
struct Row {
    std::string point; ///< choice point
    std::string method;
    std::string subject; ///< what it was measured on: `ior 1.5`, `gold`
    std::string error;   ///< what the errors are of: `albedo`, `reflectance`, `noise`
    double ns = 0.0;     ///< median time of an evaluation, one thread
    double nsLow = 0.0;  ///< quartiles
    double nsHigh = 0.0;
    double mean = 0.0; ///< errors, absolute, over a grid of cell centres
    double largest = 0.0;
    double rms = 0.0;
    std::string kind;               ///< of lobe: `dielectric`, `conductor`, `schlick`; empty: any
    double reflectance = -1.0;      ///< of the subject at normal incidence; -1: it is no matter
    std::string axis = "roughness"; ///< what the bins are of: root of alpha, or `thickness` in nm
    double axisEnd = 1.0;           ///< they are evenly spaced from 0 to here
    Cells errors{}; ///< mean absolute error, bin by bin, in each the quarters of the cosine
    Cells truths{}; ///< mean of what the error is of
};

/// Errors over a grid.
class Errors {
public:
    /// An error that is known to be at no place: it counts in all cells.
    void add(double e);
    /// @param place along the row's axis, 0..1; negative: it counts in all bins
    /// @param cosine of the view, 0..1
    /// @param sigma standard error of the truth itself, which is no error of the method
    void add(double e, double truth, double place, double cosine, double sigma = 0.0);
    void into(Row& row) const;

private:
    void count(double e);

    double _sum = 0.0, _squares = 0.0, _largest = 0.0;
    int _count = 0;
    std::array<double, binCount * cosineCount> _errors{}, _squared{}, _noise{}, _truths{},
        _counts{};
};

/// Times `evaluate(i)` for i in [0, count): one warm batch, then at least 31 of them, each all of
/// i. Its results are summed so that nothing is left out.
void time(const std::function<double(int)>& batch, int evaluations, Row& row);

/// Rows of one choice point. CMake lists these functions.
#define PATINA_MEASURED(point) std::vector<Row> point(bool timed);
#include "shaders/measuredPoints.inc"
#undef PATINA_MEASURED

/// Rows of the truth of energyCompensation, a part of it.
std::vector<Row> energyTruth(bool timed);

/// Rows of all choice points that concern lobes by themselves, or of `point` alone; layering has
/// materialNetwork/measure, domeLight hdDelegate/raster/measure.
std::vector<Row> measureMethods(const std::string& point, bool timed);

} // namespace patina::measure

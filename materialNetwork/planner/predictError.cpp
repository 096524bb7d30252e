// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/planner/predictError.h"

#include "materialNetwork/plan/methodTable.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

namespace patina {

namespace {

/// Tabulating an albedo when a material is compiled is spread over so many evaluations.
constexpr double evaluationsPerTable = 1e6;
constexpr double tableNodes = 512;

/// A row and how much it counts.
struct Near {
    const MeasuredMethod* row;
    double weight;
};

/// The rows of one method.
class MethodRows {
public:
    MethodRows(const std::string& point, const std::string& method) {
        for (const MeasuredMethod& row : methodTable())
            if (point == row.point && method == row.method) _all.push_back(&row);
    }

    /// Those that a closure lies between: of its kind, the two nearest in reflectance on either
    /// side, by the roots of their reflectances. Rows that know none come all.
    std::vector<Near> around(const ClosureContribution& contribution) {
        const MeasuredMethod *below = nullptr, *above = nullptr;
        std::vector<Near> result;
        for (const MeasuredMethod* row : kin(contribution.kind)) {
            if (row->reflectance < 0.0f) {
                result.push_back({row, 1.0});
            } else if (row->reflectance <= contribution.reflectance) {
                if (!below || row->reflectance > below->reflectance) below = row;
            } else if (!above || row->reflectance < above->reflectance) {
                above = row;
            }
        }
        if (below && above) {
            const double a = std::sqrt(below->reflectance), b = std::sqrt(above->reflectance);
            const double f = (std::sqrt(double(contribution.reflectance)) - a) / (b - a);
            result.push_back({below, 1.0 - f});
            result.push_back({above, f});
        } else if (below || above) {
            result.push_back({below ? below : above, 1.0});
        }
        return result;
    }

private:
    /// Rows of a kind, or all where there are none.
    /// @param kind of a table; known again by where it stands
    const std::vector<const MeasuredMethod*>& kin(const char* kind) {
        const auto known = _kin.find(kind);
        if (known != _kin.end()) return known->second;
        std::vector<const MeasuredMethod*>& rows = _kin[kind];
        for (const MeasuredMethod* row : _all)
            if (std::string(row->kind) == kind) rows.push_back(row);
        if (rows.empty()) rows = _all;
        return rows;
    }

    std::vector<const MeasuredMethod*> _all;
    std::map<const char*, std::vector<const MeasuredMethod*>> _kin;
};

/// A row's error and what it is of, at a place along its axis and a quarter of the cosine.
struct Cell {
    double error, truth;
    bool known;
};

Cell cellOf(const MeasuredMethod& row, const ClosureContribution& contribution, int quarter) {
    const double place =
        std::string_view(row.axis) == "thickness" ? contribution.thickness : contribution.roughness;
    const double x = place / row.axisEnd * methodBins - 0.5;
    const int i = std::clamp(int(std::floor(x)), 0, methodBins - 2);
    const double f = std::clamp(x - i, 0.0, 1.0);
    const auto at = [&](const float* cells) {
        return cells[i * methodCosines + quarter] * (1.0 - f) +
               cells[(i + 1) * methodCosines + quarter] * f;
    };
    return {at(row.errors), at(row.truths), place <= row.axisEnd * 1.0001};
}

bool makesNoise(const MeasuredMethod& row) {
    return std::string_view(row.errorOf) == "noise";
}

/// Mirrors need none of these.
bool onlyRough(const std::string& point) {
    return point == "energyCompensation" || point == "directionalAlbedo" || point == "sampling";
}

class Predictor {
public:
    Predictor(const Plan& plan, const std::string& point, const std::string& method)
        : _plan(plan), _point(point), _rows(point, method),
          _choice(Choice(findChoicePoint(point) - choicePoints().data())) {}

    Prediction run(const std::vector<std::vector<DirectionProbe>>& places) {
        for (const auto& angles : places) {
            double mean = 0.0, worst = 0.0, ns = 0.0;
            for (const DirectionProbe& probe : angles) {
                const double error = errorOf(probe, ns);
                mean += error / double(angles.size());
                worst = std::max(worst, error);
            }
            _result.error = std::max(_result.error, 0.5 * (mean + worst));
            _result.ns = std::max(_result.ns, ns / double(std::max<size_t>(angles.size(), 1)));
        }
        return _result;
    }

private:
    double errorOf(const DirectionProbe& probe, double& ns) {
        const int quarter = std::clamp(int(probe.cosine * methodCosines), 0, methodCosines - 1);
        double sum = 0.0;
        for (const ClosureContribution& contribution : probe.closures) {
            if (!matters(_plan, _plan.closures[size_t(contribution.closure)], _choice)) continue;
            if (onlyRough(_point) && contribution.roughness <= 0.0f) {
                _result.measured = true;
                continue;
            }
            double between = 0.0, worst = 0.0, time = 0.0, weights = 0.0;
            for (const Near& near : _rows.around(contribution)) {
                const Cell cell = cellOf(*near.row, contribution, quarter);
                _result.measured = true;
                time += near.weight * near.row->ns;
                weights += near.weight;
                if (makesNoise(*near.row))
                    _result.noise = std::max(_result.noise, cell.error * contribution.share);
                else if (near.row->reflectance < 0.0f)
                    worst = std::max(worst, contributedError(*near.row, contribution, cell));
                else
                    between += near.weight * contributedError(*near.row, contribution, cell);
            }
            sum += std::max(between, worst);
            time /= std::max(weights, 1.0);
            if (contribution.tabulated && _point == "directionalAlbedo")
                time *= tableNodes / evaluationsPerTable;
            ns += time;
        }
        return sum;
    }

    double contributedError(const MeasuredMethod& row, const ClosureContribution& contribution,
                            const Cell& cell) const {
        if (!cell.known) return 1.0; // nothing is known of films that thick
        const double own = cell.error / std::max(cell.truth, 1e-6);
        // Compensation takes from the albedo only what facets lose, times their reflectance.
        const double counts =
            _point == "directionalAlbedo" ? std::min(contribution.reflectance + 0.05, 1.0) : 1.0;
        const bool ofLight = std::string_view(row.errorOf) == "albedo" ||
                             std::string_view(row.errorOf) == "reflectance";
        const double below = ofLight && contribution.beneath > 0.0f
                                 ? cell.error / std::max(1.0 - cell.truth, 0.01)
                                 : 0.0;
        return std::min(own, 1.0) * counts * contribution.share +
               std::min(below, 1.0) * contribution.beneath;
    }

    const Plan& _plan;
    const std::string& _point;
    MethodRows _rows;
    Choice _choice;
    Prediction _result;
};

} // namespace

Prediction predict(const Plan& plan, const std::vector<std::vector<DirectionProbe>>& places,
                   const std::string& point, const std::string& method) {
    return Predictor(plan, point, method).run(places);
}

} // namespace patina

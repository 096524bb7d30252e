// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/plan/scenePlan.h"

#include "hdDelegate/plan/subdivisionPlan.h"
#include "materialNetwork/plan/methodTable.h"
#include "materialNetwork/plan/methods.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>

namespace patina {

namespace {

/// The columns of rows of `roulette`: depths. plugin/patina/chart/measurePaths.py measures them.
constexpr double depths[methodCosines] = {4.0, 16.0, 64.0, 256.0};

/// The fewest vertices among the methods of `pathDepth` that are enough.
int depthOfAtLeast(double vertices) {
    int minimum = ScenePlan::maxPlannedDepth;
    for (const ChoicePoint& choice : choicePoints())
        if (choice.name == "pathDepth")
            for (const Method& m : choice.methods) {
                const int depth = std::atoi(m.name.c_str());
                if (depth >= vertices) minimum = std::min(minimum, depth);
            }
    return minimum;
}

/// Time times variance of a method of `roulette` over those of the default, the geometric mean of
/// the subjects. Beyond the depths that were measured paths that none ends take longer with each.
double effort(const std::string& method, double albedo, int depth) {
    const double x = std::clamp(albedo * methodBins - 0.5, 0.0, double(methodBins - 1));
    int column = 0;
    while (column < methodCosines - 2 && depth > depths[column + 1])
        ++column;
    const double y = std::clamp(
        std::log(depth / depths[column]) / std::log(depths[column + 1] / depths[column]), 0.0, 1.0);
    const int bin = std::min(int(x), methodBins - 2);
    double logs = 0.0;
    int count = 0;
    for (const MeasuredMethod& row : methodTable()) {
        if (std::string(row.point) != "roulette" || method != row.method) continue;
        const auto at = [&](int b) {
            const float* cells = row.errors + b * methodCosines + column;
            return std::max(cells[0] * (1.0 - y) + cells[1] * y, 1e-6);
        };
        logs += std::log(at(bin)) * (1.0 - (x - bin)) + std::log(at(bin + 1)) * (x - bin);
        ++count;
    }
    const double beyond = method == "none" ? std::max(1.0, depth / depths[methodCosines - 1]) : 1.0;
    return count ? std::exp(logs / count) * beyond : 1.0;
}

} // namespace

void ScenePlan::add(const std::string& path, const MethodPlan& material) {
    _materials[path] = material;
    _error = std::max(_error, material.error);
    _albedo = std::max(_albedo, material.albedo);
}

void ScenePlan::add(const PlannedMethod& choice) {
    if (choice.point.empty()) return;
    if (choice.point == "subdivision") _subdivision = choice.error;
    if (choice.point == "pathDepth") _depth = choice.error;
    _choices.push_back(choice);
}

void ScenePlan::addPaths(const RenderSettings& settings) {
    if (settings.tolerance < 0.0) return;
    add(pathDepth(settings));
    add(roulette(settings));
}

PlannedMethod ScenePlan::pathDepth(const RenderSettings& settings) const {
    PlannedMethod result;
    if (settings.maxDepth >= 0) return result;
    const auto left = [&](const std::string& method) {
        return std::pow(_albedo, std::atof(method.c_str()));
    };
    result.point = "pathDepth";
    result.method = std::to_string(depth(settings));
    result.forced = settings.methods.count(result.point) > 0;
    result.measured = true;
    const std::string standard = chosenMethod({}, result.point), truth = truthMethod(result.point);
    result.error = result.method == truth ? 0.0 : left(result.method);
    result.errorDefault = left(standard);
    result.ns = methodFigures(result.point, result.method).cost;
    result.nsDefault = 1.0;
    result.nsTruth = methodFigures(result.point, truth).cost;
    return result;
}

PlannedMethod ScenePlan::roulette(const RenderSettings& settings) const {
    PlannedMethod result;
    result.point = "roulette";
    result.forced = settings.methods.count(result.point) > 0;
    result.measured = true;
    result.method = chosenMethod(settings.methods, result.point);
    const int vertices = depth(settings);
    if (!result.forced)
        for (const ChoicePoint& choice : choicePoints())
            if (choice.name == result.point)
                for (const Method& m : choice.methods)
                    if (effort(m.name, _albedo, vertices) <
                        effort(result.method, _albedo, vertices))
                        result.method = m.name;
    result.ns = effort(result.method, _albedo, vertices);
    result.nsDefault = result.nsTruth = 1.0;
    return result;
}

int ScenePlan::depth(const RenderSettings& settings) const {
    if (settings.maxDepth >= 0) return settings.maxDepth;
    const auto forced = settings.methods.find("pathDepth");
    if (forced != settings.methods.end()) return std::atoi(forced->second.c_str());
    const double tolerance = settings.tolerance;
    if (tolerance < 0.0) return depthStandard;
    if (tolerance == 0.0 || _albedo >= 1.0) return maxPlannedDepth;
    if (_albedo <= 0.0) return depthOfAtLeast(0.0);
    return depthOfAtLeast(std::log(depthShare * tolerance) / std::log(_albedo));
}

int ScenePlan::rouletteDepth(const RenderSettings& settings) const {
    const bool planned = settings.tolerance >= 0.0;
    const std::string method =
        planned ? roulette(settings).method : chosenMethod(settings.methods, "roulette");
    return method == "none" ? INT_MAX : settings.rouletteDepth;
}

double ScenePlan::noise(double tolerance) const {
    if (!(tolerance > 0.0)) return tolerance;
    // Biases may all have one sign.
    const double bias = std::min(_error, methodShare * tolerance) +
                        std::min(_subdivision, subdivisionShare * tolerance) +
                        std::min(_depth, depthShare * tolerance);
    return noiseBeside(bias, tolerance);
}

void ScenePlan::addStatistics(double tolerance, std::map<std::string, double>& statistics) const {
    if (tolerance < 0.0) return;
    statistics["predictedError"] = _error;
    statistics["noiseTolerance"] = noise(tolerance);
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/planner/predictLight.h"

#include "materialNetwork/plan/methodTable.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace patina {

namespace {

constexpr float metallic = 0.2f; ///< Schlick's curve is measured as a metal from there on

/// The kind of lobe that rows of lights are of; empty where there is none.
std::string kindOf(const ClosureContribution& contribution) {
    const std::string kind = contribution.kind;
    if (kind == "schlick") return contribution.reflectance > metallic ? "conductor" : "dielectric";
    if (kind == "subsurface") return "diffuse";
    for (const char* known : {"diffuse", "sheen", "dielectric", "conductor"})
        if (kind == known) return kind;
    return "";
}

const MeasuredMethod* rowOf(const std::string& point, const std::string& method,
                            const std::string& subject) {
    for (const MeasuredMethod& row : methodTable())
        if (point == row.point && method == row.method && subject == row.subject) return &row;
    return nullptr;
}

double errorAt(const MeasuredMethod& row, double roughness, int quarter) {
    const double x =
        std::clamp(roughness / row.axisEnd * methodBins - 0.5, 0.0, double(methodBins - 1));
    const int bin = std::min(int(x), methodBins - 2);
    const auto at = [&](int b) {
        const int cell = b * methodCosines + quarter;
        return double(row.errors[cell]) / std::max(double(row.truths[cell]), 1e-6);
    };
    return std::min(at(bin) * (1.0 - (x - bin)) + at(bin + 1) * (x - bin), 1.0);
}

} // namespace

LightPrediction predictLight(const std::vector<std::vector<DirectionProbe>>& places,
                             const std::string& point, const std::string& method,
                             const std::string& light, const std::string& count) {
    LightPrediction result;
    result.measured = true;
    std::map<std::string, const MeasuredMethod*> rows;
    const auto rowFor = [&](const std::string& kind) {
        const auto known = rows.find(kind);
        if (known != rows.end()) return known->second;
        const std::string subject = kind + ", " + light + (count.empty() ? "" : ", " + count);
        return rows[kind] = rowOf(point, method, subject);
    };
    for (const auto& angles : places) {
        double mean = 0.0, worst = 0.0, time = 0.0;
        for (const DirectionProbe& probe : angles) {
            const int quarter = std::clamp(int(probe.cosine * methodCosines), 0, methodCosines - 1);
            double error = 0.0;
            for (const ClosureContribution& contribution : probe.closures) {
                const std::string kind = kindOf(contribution);
                if (std::string(contribution.kind).compare(0, 5, "layer") == 0) continue;
                // The outlines of areas leave sheen to samples.
                if (kind == "sheen" && point == "areaLight") continue;
                const MeasuredMethod* row = rowFor(kind);
                if (!row) {
                    result.measured = false;
                    continue;
                }
                error += contribution.share * errorAt(*row, contribution.roughness, quarter);
                time += row->ns / double(angles.size());
            }
            mean += error / double(angles.size());
            worst = std::max(worst, error);
        }
        result.error = std::max(result.error, 0.5 * (mean + worst));
        result.ns = std::max(result.ns, time);
    }
    return result;
}

} // namespace patina

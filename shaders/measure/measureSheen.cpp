// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"
#include "shaders/measure/places.h"
#include "shaders/measure/sheenFit.h"

namespace patina::measure {

namespace {

constexpr int gridSide = 32;

float byFit(sh::SheenLobe l, float mu) {
    return std::min(sheenAlbedoFit(mu, l.roughness), 1.0f);
}

} // namespace

// The total reflection of the Conty-Kulla lobe, against a sum in double over four times as many
// directions as its quadrature has.
std::vector<Row> sheen(bool timed) {
    const struct {
        const char* name;
        int method;
        float (*albedo)(sh::SheenLobe, float);
        int evaluations;
    } methods[] = {{"table", sh::SHEEN_TABLED, sh::sheenWhiteAlbedo, 1024},
                   {"fit", sh::SHEEN_TABLED, byFit, 1024},
                   {"quadrature", sh::SHEEN_QUADRATURE, sh::sheenWhiteAlbedo, 8}};
    constexpr int fineSteps = 2;
    const std::vector<Place> grid = places(gridSide);
    const auto roughnessAt = [](const Place& p) {
        return std::max(double(sh::SHEEN_ROUGHNESS_MIN), p.alpha);
    };
    std::vector<double> truth;
    for (const Place& p : grid) {
        const int heights = sh64::SHEEN_HEIGHTS * fineSteps,
                  azimuths = sh64::SHEEN_AZIMUTHS * fineSteps;
        double sum = 0.0;
        for (int i = 0; i < heights; ++i) {
            const double t = (i + 0.5) / heights, z = t * t, r = std::sqrt(1.0 - z * z);
            for (int j = 0; j < azimuths; ++j) {
                const double phi = 3.141592653589793 * (j + 0.5) / azimuths;
                const sh64::vec3 wi(r * std::cos(phi), r * std::sin(phi), z);
                sum += t * sh64::sheenContyKulla(roughnessAt(p), p.wo, wi).x;
            }
        }
        truth.push_back(std::min(sum * 4.0 * 3.141592653589793 / (heights * azimuths), 1.0));
    }
    std::vector<Row> rows;
    for (const auto& method : methods) {
        Row row;
        row.point = "sheen";
        row.method = method.name;
        row.subject = "conty_kulla";
        row.error = "albedo";
        row.kind = "sheen";
        std::vector<sh::SheenLobe> lobes;
        Errors errors;
        for (size_t i = 0; i < grid.size(); ++i) {
            lobes.push_back(sh::sheenMethods(
                sh::sheenSetup(sh::vec3(1.0f), float(roughnessAt(grid[i])), sh::SHEEN_CONTY_KULLA),
                method.method));
            errors.add(double(method.albedo(lobes.back(), float(grid[i].wo.z))) - truth[i],
                       truth[i], std::sqrt(roughnessAt(grid[i])), grid[i].wo.z);
        }
        errors.into(row);
        if (timed)
            time(
                [&](int n) {
                    float sum = 0.0f;
                    for (int i = 0; i < n; ++i) {
                        const size_t j = size_t(i) * 37 % grid.size();
                        sum += method.albedo(lobes[j], float(grid[j].wo.z));
                    }
                    return double(sum);
                },
                method.evaluations, row);
        rows.push_back(row);
    }
    return rows;
}

} // namespace patina::measure

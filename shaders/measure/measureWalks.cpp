// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"
#include "shaders/measure/microsurfaceWalk.h"
#include "shaders/measure/places.h"

namespace patina::measure {

namespace {

constexpr int gridSide = 16;
constexpr int walksTogether = 16; // walks that are timed at once

} // namespace

// The truth that the other methods are measured against: it has no error, only a time.
std::vector<Row> energyTruth(const bool timed) {
    const struct {
        const char* name;
        const char* kind;
        std::function<double(double)> reflectance;
    } subjects[] = {
        {"white metal", "conductor", [](double) { return 1.0; }},
        {measuredMetals[0].name, "conductor",
         [](double c) {
             return sh64::fresnelConductorChannel(c, measuredMetals[0].n, measuredMetals[0].k);
         }},
        {measuredMetals[1].name, "conductor",
         [](double c) {
             return sh64::fresnelConductorChannel(c, measuredMetals[1].n, measuredMetals[1].k);
         }},
        {"ior 1.5", "dielectric", [](double c) { return sh64::fresnelDielectric(c, 1.5); }},
        {"ior 3", "dielectric", [](double c) { return sh64::fresnelDielectric(c, 3.0); }}};
    std::vector<Place> grid;
    for (const Place& p : places(gridSide))
        if (p.alpha >= sh64::ALPHA_MIRROR) grid.push_back(p);
    std::vector<Row> rows;
    for (const auto& subject : subjects) {
        Row row;
        row.point = "energyCompensation";
        row.method = "randomWalk";
        row.subject = subject.name;
        row.error = "albedo";
        row.kind = subject.kind;
        row.reflectance = subject.reflectance(1.0);
        Errors errors;
        errors.add(0.0);
        errors.into(row);
        if (timed)
            time(
                [&](int n) {
                    double sum = 0.0;
                    for (int i = 0; i < n / walksTogether; ++i) {
                        const Place& p = grid[size_t(i) * 37 % grid.size()];
                        sum +=
                            walkMicrosurface(p.wo, sh64::vec2(p.alpha), sh::NDF_GGX,
                                             subject.reflectance, walksTogether, std::uint64_t(i))
                                .all;
                    }
                    return sum;
                },
                256 * walksTogether, row);
        rows.push_back(row);
    }
    return rows;
}

} // namespace patina::measure

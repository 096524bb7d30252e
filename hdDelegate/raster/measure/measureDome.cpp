// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/measure/measureDome.h"

#include "hdDelegate/raster/measure/domeMethods.h"

#include <cmath>

namespace patina::measure {

namespace {

using glm::vec3;

constexpr int gridSide = 8;      ///< places: cosines, and roots of alpha
constexpr int normalCount = 8;   ///< at each place
constexpr int usualSamples = 16; ///< samples of filtered parts of other methods: RenderSettings

/// A way of the choice point, and what its rows are told apart by.
struct Way {
    const char* method;
    int count; ///< of passes, or of samples in one
    const char* of;
};
constexpr Way ways[] = {{"sampled", 1, ""},
                        {"sampled", 16, " passes"},
                        {"filtered", 4, " samples"},
                        {"filtered", 16, " samples"},
                        {"filtered", 64, " samples"},
                        {"filtered", 256, " samples"},
                        {"filtered", 1024, " samples"},
                        {"prefiltered", 1, ""},
                        {"harmonics", 1, ""},
                        {"harmonicsUnwindowed", 1, ""}};

double light(const DomePoint& p, const MeasuredSky& sky, const Way& way, uint32_t seed) {
    const std::string method = way.method;
    if (method == "sampled") return bySampling(p, sky, way.count, seed);
    if (method == "filtered") return byFiltering(p, sky, way.count, seed);
    if (!p.lobe.mirrors()) return byHarmonics(p, sky, method == "harmonicsUnwindowed");
    return method == "prefiltered" ? byPrefiltering(p, sky)
                                   : byFiltering(p, sky, usualSamples, seed);
}

/// Points over the sphere, even and in no order of places (a Fibonacci lattice).
std::vector<DomePoint> pointsOf(Reflector::Kind kind) {
    const std::vector<Place> grid = places(gridSide);
    const int count = int(grid.size()) * normalCount, stride = 331; // prime to the count
    std::vector<DomePoint> points;
    for (int i = 0; i < count; ++i) {
        const int k = i * stride % count;
        const float z = 1.0f - (2.0f * float(k) + 1.0f) / float(count), turn = 2.39996323f;
        const float r = std::sqrt(1.0f - z * z), phi = turn * float(k);
        points.emplace_back(Reflector(kind, grid[size_t(i / normalCount)]),
                            vec3(r * std::cos(phi), z, r * std::sin(phi)), turn * float(i));
    }
    return points;
}

void timeLight(const std::vector<DomePoint>& points, const MeasuredSky& sky, const Way& way,
               Row& row) {
    time(
        [&](int n) {
            double sum = 0.0;
            for (int i = 0; i < n; ++i)
                sum += light(points[size_t(i) * 97 % points.size()], sky, way, uint32_t(i));
            return sum;
        },
        way.count > 16 ? 16 : 128, row);
}

} // namespace

std::vector<Row> domeLight(bool timed) {
    std::vector<Row> rows;
    const MeasuredSky skies[] = {MeasuredSky::constant(), MeasuredSky::soft(), MeasuredSky::sun()};
    for (const auto kind :
         {Reflector::Diffuse, Reflector::Sheen, Reflector::Dielectric, Reflector::Conductor}) {
        const std::vector<DomePoint> points = pointsOf(kind);
        for (const MeasuredSky& sky : skies) {
            std::vector<double> truths;
            for (const DomePoint& p : points)
                truths.push_back(domeTruth(p, sky));
            for (const Way& way : ways) {
                Row row;
                row.point = "domeLight";
                row.method = way.method;
                row.subject = std::string(Reflector::name(kind)) + ", " + sky.name +
                              (*way.of ? ", " + std::to_string(way.count) + way.of : "");
                row.error = "light";
                row.kind = Reflector::name(kind);
                Errors errors;
                for (size_t i = 0; i < points.size(); ++i)
                    errors.add(light(points[i], sky, way, uint32_t(i)) - truths[i], truths[i],
                               std::sqrt(double(points[i].lobe.alpha)), points[i].lobe.wo.z);
                errors.into(row);
                if (timed) timeLight(points, sky, way, row);
                rows.push_back(row);
            }
        }
    }
    return rows;
}

} // namespace patina::measure

#include "shaders/measure/measure.h"
#include "shaders/measure/places.h"

namespace patina::measure {

namespace {

constexpr int kSide = 32;
constexpr double kIor = 1.5;

double reflected(double alpha, sh::vec3 wo) {
    const sh::DielectricLobe l = sh::dielectricMethods(
        sh::dielectricSetup(sh::vec3(1.0f), float(kIor), sh::vec2(float(alpha)), false,
                            sh::SCATTER_R, false, sh::COMPENSATE_SCALE),
        sh::ALBEDO_FIT, sh::FACETS_VISIBLE, sh::FRESNEL_EXACT);
    return double(sh::dielectricAlbedo(l, wo).x);
}

} // namespace

// An interface over a Lambert base of albedo a. What the base sends up is spread by the cosine
// again, so all that bounces between the two is a geometric series: with E what the interface
// reflects from outside and R the mean of what it reflects from inside, the whole reflects
// E + (1 - E) a (1 - R) / (1 - a R). R follows from the mean of E by reciprocity,
// 1 - R = (1 - mean E) / ior^2. Scaling by albedo takes E + (1 - E) a instead.
std::vector<Row> layering(bool timed) {
    const std::vector<Place> grid = places(kSide);
    std::vector<double> e, inside;
    for (int a = 0; a < kSide; ++a) {
        double mean = 0.0;
        for (int m = 0; m < kSide; ++m) {
            const Place& p = grid[size_t(a * kSide + m)];
            e.push_back(reflected(p.alpha, sh::vec3(p.wo)));
            mean += 2.0 * p.wo.z * e.back() / kSide;
        }
        inside.push_back(1.0 - (1.0 - mean) / (kIor * kIor));
    }
    std::vector<Row> rows;
    for (const auto& [albedo, subject] : {std::pair(0.05, "coat over 0.05"),
                                          {0.2, "coat over 0.2"},
                                          {0.5, "coat over 0.5"},
                                          {0.8, "coat over 0.8"},
                                          {0.95, "coat over 0.95"}}) {
        Row row;
        row.point = "layering";
        row.method = "albedoScaling";
        row.subject = subject;
        row.error = "albedo";
        row.kind = "layer";
        row.reflectance = albedo;
        Errors errors;
        for (size_t i = 0; i < grid.size(); ++i) {
            const double r = inside[i / kSide], a = albedo;
            const double truth = e[i] + (1.0 - e[i]) * a * (1.0 - r) / (1.0 - a * r);
            errors.add(e[i] + (1.0 - e[i]) * a - truth, truth, std::sqrt(grid[i].alpha),
                       grid[i].wo.z);
        }
        errors.into(row);
        if (timed)
            time(
                [&](int n) {
                    double sum = 0.0;
                    for (int i = 0; i < n; ++i) {
                        const Place& p = grid[size_t(i * 37) % grid.size()];
                        sum += 1.0 - reflected(p.alpha, sh::vec3(p.wo));
                    }
                    return sum;
                },
                512, row);
        rows.push_back(row);
    }
    return rows;
}

} // namespace patina::measure

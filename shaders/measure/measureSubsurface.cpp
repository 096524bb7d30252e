// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "shaders/shaders.h"

namespace patina::measure {

namespace {

constexpr int walkCount = 40000;
constexpr int maxSteps = 1024;

/// The single scattering albedo of which a half space has this albedo under diffuse light, after
/// van de Hulst (hdDelegate/embree/media/randomWalk.h), for isotropic scattering.
double singleAlbedo(double albedo) {
    const double b = 1.139 + 1.17 * albedo;
    const double s = 2.0 * (1.0 - albedo) / (b + std::sqrt(b * b - 0.556 * (1.0 - albedo)));
    return 1.0 - s * s;
}

class Mean {
public:
    void add(double x) {
        _sum += x;
        _squares += x * x;
        ++_count;
    }
    double mean() const { return _sum / _count; }
    double sigma() const {
        return std::sqrt(std::max(_squares / _count - mean() * mean(), 0.0) / _count);
    }

private:
    double _sum = 0.0, _squares = 0.0;
    int _count = 0;
};

/// Light that goes in spread by the cosine and scatters until it comes out: its weight.
double walkHalfSpace(double single, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    double depth = 0.0, down = std::sqrt(uniform(random)), weight = 1.0;
    for (int step = 0; step < maxSteps; ++step) {
        depth -= std::log(1.0 - uniform(random)) * down;
        if (depth <= 0.0) return weight;
        weight *= single;
        if (weight < 0.1) {
            if (uniform(random) >= weight) return 0.0;
            weight = 1.0;
        }
        down = 2.0 * uniform(random) - 1.0;
    }
    return weight;
}

} // namespace

// A diffuse lobe has the albedo that was asked for, a walk the one that its inversion finds: how
// far both are apart for an infinitely thick object. The part that only one of them shows, light
// that leaves elsewhere, hangs on the object.
std::vector<Row> subsurface(bool timed) {
    std::vector<Row> rows;
    const struct {
        const char* name;
        double albedo;
    } subjects[] = {{"albedo 0.2", 0.2}, {"albedo 0.5", 0.5}, {"albedo 0.8", 0.8}};
    for (const char* method : {"randomWalk", "diffuse"})
        for (const auto& subject : subjects) {
            Row row;
            row.point = "subsurface";
            row.method = method;
            row.subject = subject.name;
            row.error = "albedo";
            row.kind = "subsurface";
            row.reflectance = subject.albedo;
            const bool walks = row.method == "randomWalk";
            const double single = singleAlbedo(subject.albedo);
            std::mt19937_64 random(7);
            Mean truth;
            for (int i = 0; i < walkCount; ++i)
                truth.add(walkHalfSpace(single, random));
            Errors errors;
            for (int i = 0; i < cosineCount; ++i)
                errors.add(walks ? 0.0 : subject.albedo - truth.mean(), truth.mean(), -1.0,
                           (i + 0.5) / cosineCount, truth.sigma());
            errors.into(row);
            const sh::OrenNayarLobe lobe =
                sh::orenNayarSetup(sh::vec3(float(subject.albedo)), 0.0f, false);
            if (timed)
                time(
                    [&](int n) {
                        double sum = 0.0;
                        for (int i = 0; i < n; ++i) {
                            const float z = (float(i) + 0.5f) / float(n);
                            const sh::vec3 wi(std::sqrt(1.0f - z * z), 0.0f, z);
                            sum +=
                                walks ? walkHalfSpace(single, random)
                                      : double(
                                            sh::orenNayarEval(lobe, sh::vec3(0, 0, 1), wi).value.x);
                        }
                        return sum;
                    },
                    256, row);
            rows.push_back(row);
        }
    return rows;
}

} // namespace patina::measure

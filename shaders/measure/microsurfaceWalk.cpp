// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/microsurfaceWalk.h"

#include <random>

namespace patina::measure {

using namespace sh64;

namespace {

constexpr int maxBounces = 200;
constexpr double steepCosine = 1e-6; // |z| below which a ray stays at its height

/// Smith's Lambda, for directions that rise or fall: Lambda(-w) = -1 - Lambda(w).
double lambda(vec3 w, vec2 alpha, int ndf) {
    const vec3 up = w.z < 0.0 ? -w : w;
    const double rising =
        0.5 * (microfacetLength(up, alpha, ndf) / std::max(up.z, steepCosine) - 1.0);
    return w.z < 0.0 ? -1.0 - rising : rising;
}

/// Share of the surface below where a ray along w that starts at `below` meets it; above 1 when it
/// leaves. Heights enter only as this share, so their distribution does not matter.
double nextBelow(vec3 w, double below, vec2 alpha, int ndf, double u) {
    if (std::fabs(w.z) < steepCosine) return below;
    const double l = lambda(w, alpha, ndf);
    if (w.z > 0.0) {
        if (l < 1e-12) return 2.0;
        if (u >= 1.0 - std::pow(below, l)) return 2.0;
    }
    return below / std::pow(1.0 - u, 1.0 / l);
}

} // namespace

Walked walkMicrosurface(vec3 wo, vec2 alpha, int ndf,
                        const std::function<double(double)>& reflectance, int walks,
                        std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Walked result;
    double squares = 0.0;
    for (int i = 0; i < walks; ++i) {
        vec3 w = -wo;
        double below = 1.0;
        double weight = 1.0;
        for (int bounce = 0; bounce < maxBounces; ++bounce) {
            below = nextBelow(w, below, alpha, ndf, uniform(random));
            if (below > 1.0) {
                if (bounce == 1) result.once += weight;
                result.all += weight;
                squares += weight * weight;
                break;
            }
            const double u = uniform(random);
            const vec3 m = microfacetSampleVisible(-w, alpha, vec2(u, uniform(random)), ndf);
            const double c = std::min(std::max(-dot(w, m), 0.0), 1.0);
            weight *= reflectance(c);
            w = sh64::normalize(w + m * (2.0 * c));
        }
    }
    result.walks = walks;
    result.all /= walks;
    result.once /= walks;
    result.sigma = std::sqrt(std::max(squares / walks - result.all * result.all, 0.0) / walks);
    return result;
}

} // namespace patina::measure

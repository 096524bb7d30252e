#include "shaders/bake/albedoQuadrature.h"

#include <cmath>

namespace patina::bake {

using namespace sh64;

GaussRule::GaussRule(int n) : x(n), w(n) {
    for (int i = 0; i < n; ++i) {
        double z = std::cos(sh64::PI * (i + 0.75) / (n + 0.5));
        double slope = 1.0;
        for (int step = 0; step < 100; ++step) {
            double p = 1.0;
            double previous = 0.0;
            for (int k = 1; k <= n; ++k) {
                const double older = previous;
                previous = p;
                p = ((2 * k - 1) * z * previous - (k - 1) * older) / k;
            }
            slope = n * (z * p - previous) / (z * z - 1.0);
            const double change = p / slope;
            z -= change;
            if (std::fabs(change) < 1e-15) break;
        }
        x[i] = 0.5 * (1.0 - z);
        w[i] = 1.0 / ((1.0 - z * z) * slope * slope);
    }
}

void InterfaceQuadrature::moments(double mu, double alpha, const double* exponents, int count,
                                  double* result) const {
    for (int k = 0; k < count; ++k)
        result[k] = 0.0;
    if (alpha <= 0.0) {
        for (int k = 0; k < count; ++k)
            result[k] = powSchlick(1.0 - mu, exponents[k]);
        return;
    }
    forEachNormal(mu, alpha, [&](double weight, double c, vec3 wo, vec3 m) {
        const GgxBounce b = ggxBounce(wo, m, c, vec2(alpha), 1.0, true);
        if (!b.valid) return;
        for (int k = 0; k < count; ++k)
            result[k] += weight * b.ratio * powSchlick(1.0 - c, exponents[k]);
    });
}

vec2 InterfaceQuadrature::dielectric(double mu, double alpha, double eta) const {
    if (alpha <= 0.0) return vec2(fresnelDielectric(mu, eta), 1.0 - fresnelDielectric(mu, eta));
    double reflected = 0.0;
    double transmitted = 0.0;
    forEachNormal(mu, alpha, [&](double weight, double c, vec3 wo, vec3 m) {
        const double f = fresnelDielectric(c, eta);
        const GgxBounce r = ggxBounce(wo, m, c, vec2(alpha), eta, true);
        if (r.valid) reflected += weight * f * r.ratio;
        const GgxBounce t = ggxBounce(wo, m, c, vec2(alpha), eta, false);
        if (t.valid && f < 1.0) transmitted += weight * (1.0 - f) * t.ratio;
    });
    return vec2(reflected, transmitted);
}

} // namespace patina::bake

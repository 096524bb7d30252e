// SPDX-License-Identifier: Apache-2.0
#include "shaders/bake/albedoQuadrature.h"

#include <algorithm>
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

vec3 slanted(double mu) {
    return vec3(std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu);
}

void InterfaceQuadrature::setView(vec3 wo, vec2 alpha) {
    _wo = wo;
    _alpha = alpha;
    _normals.clear();
    if (alpha.x <= 0.0) {
        _normals.push_back({vec3(0.0, 0.0, 1.0), wo.z, 1.0, 1.0});
        return;
    }
    _length = microfacetLength(wo, alpha, _ndf);
    if (alpha.x != alpha.y || wo.y != 0.0) return lookAround();
    const bool ggx = _ndf == NDF_GGX;
    const std::size_t half = _rule.x.size();
    for (int i = 0; i < _columns; ++i) {
        const double golden = (i + 0.5) * 0.6180339887498949;
        const double cut = 0.2 + 0.6 * (golden - std::floor(golden));
        const double x = 0.5 * (i + 0.5) / _columns;
        for (std::size_t j = 0; j < 2 * half; ++j) {
            const bool upper = j >= half;
            const double width = upper ? 1.0 - cut : cut;
            const double y = (upper ? cut : 0.0) + width * _rule.x[j % half];
            const double crowd = ggx ? 3.0 * y * y : 1.0;
            add(ggx ? vec2(x, 1.0 - y * y * y) : vec2(y, x),
                crowd * width * _rule.w[j % half] / _columns);
        }
    }
}

void InterfaceQuadrature::lookAround() {
    const bool ggx = _ndf == NDF_GGX;
    for (int i = 0; i < _columns; ++i)
        for (int j = 0; j < _columns; ++j) {
            const double shift = (i + 0.5) * 0.6180339887498949;
            const double x = (i + 0.5) / _columns;
            const double y = (j + shift - std::floor(shift)) / _columns;
            add(ggx ? vec2(x, 1.0 - y * y) : vec2(y, x),
                (ggx ? 2.0 * y : 1.0) / (double(_columns) * _columns));
        }
}

void InterfaceQuadrature::add(vec2 u, double weight) {
    Normal n;
    n.weight = weight;
    n.m = microfacetSampleVisible(_wo, _alpha, u, _ndf);
    n.c = std::min(std::max(sh64::dot(_wo, n.m), 0.0), 1.0);
    const vec3 wi = n.m * (2.0 * n.c) - _wo;
    n.reflected = 0.0;
    if (wi.z > 0.0)
        n.reflected =
            weight * microfacetG2OverG1(_wo.z, _length, wi.z, microfacetLength(wi, _alpha, _ndf));
    _normals.push_back(n);
}

void InterfaceQuadrature::moments(const double* exponents, int count, double* result) const {
    for (int k = 0; k < count; ++k)
        result[k] = 0.0;
    for (const Normal& n : _normals) {
        const double ln = std::log(std::max(1.0 - n.c, 1e-30));
        for (int k = 0; k < count; ++k)
            result[k] += n.reflected * std::exp(exponents[k] * ln);
    }
}

void InterfaceQuadrature::spread(int bins, double* light, double* cosine) const {
    std::fill(light, light + bins, 0.0);
    std::fill(cosine, cosine + bins, 0.0);
    for (const Normal& n : _normals) {
        const int bin = std::min(int(std::sqrt(n.c) * bins), bins - 1);
        light[bin] += n.reflected;
        cosine[bin] += n.reflected * n.c;
    }
    for (int i = 0; i < bins; ++i)
        if (light[i] > 0.0) cosine[i] /= light[i];
}

vec2 InterfaceQuadrature::dielectric(double eta) const {
    double reflected = 0.0;
    double transmitted = 0.0;
    for (const Normal& n : _normals) {
        const double f = fresnelDielectric(n.c, eta);
        reflected += f * n.reflected;
        if (f >= 1.0) continue;
        const vec3 wi = microfacetDirection(_wo, n.m, n.c, eta, false);
        double ratio = wi.z < 0.0 ? 1.0 : 0.0;
        if (_alpha.x > 0.0 && wi.z < 0.0)
            ratio = microfacetG2OverG1(_wo.z, _length, -wi.z, microfacetLength(wi, _alpha, _ndf));
        transmitted += n.weight * (1.0 - f) * ratio;
    }
    return vec2(reflected, transmitted);
}

} // namespace patina::bake

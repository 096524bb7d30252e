// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/smithSurface.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr double levelCosine = 1e-6; // |z| below which a ray stays at its height
constexpr double invRootPi = 0.56418958354775628;

} // namespace

double SmithSurface::projectedArea(const glm::vec3& v) const {
    const double x = double(_alpha.x) * v.x, y = double(_alpha.y) * v.y, z = v.z;
    const double across = x * x + y * y;
    if (_ndf != sh::NDF_BECKMANN) {
        const double length = std::sqrt(across + z * z);
        return 0.5 * (z >= 0.0 ? length + z : across / std::max(length - z, 1e-300));
    }
    const double s = std::sqrt(across);
    if (s < 1e-12) return std::max(z, 0.0);
    const double a = z / s;
    return 0.5 * std::max(z * std::erfc(-a) + s * std::exp(-a * a) * invRootPi, 0.0);
}

double SmithSurface::lambda(const glm::vec3& w) const {
    return projectedArea(-w) / double(w.z);
}

double SmithSurface::leaves(const glm::vec3& w, double below) const {
    if (!(w.z > levelCosine)) return 0.0;
    return std::pow(std::max(below, 0.0), lambda(w));
}

double SmithSurface::nextBelow(const glm::vec3& w, double below, double u) const {
    if (std::fabs(w.z) < levelCosine) return below;
    const double l = lambda(w);
    if (w.z > 0.0f && (l < 1e-12 || u >= 1.0 - std::pow(below, l))) return 2.0;
    return std::min(below / std::pow(1.0 - u, 1.0 / l), 1.0);
}

/// Slopes along v are those of facets that v, from below, sees: with b the slope of v, the density
/// of t = slope - b is that of t exp(-t^2 - 2 b t), by rejection.
glm::vec3 SmithSurface::beckmannFromBelow(const glm::vec3& v, HashedNumbers& random) const {
    double x = double(_alpha.x) * v.x, y = double(_alpha.y) * v.y;
    const double s = std::max(std::sqrt(x * x + y * y), 1e-30);
    x /= s;
    y /= s;
    const double b = -double(v.z) / s;
    const auto exponential = [&] { return -std::log(1.0 - double(random.next())); };
    double t = 0.0;
    for (int tries = 0; tries < 1000; ++tries) {
        if (b < 0.8) {
            t = std::sqrt(exponential());
            if (double(random.next()) < std::exp(-2.0 * b * t)) break;
        } else {
            t = (exponential() + exponential()) / (2.0 * b);
            if (double(random.next()) < std::exp(-t * t)) break;
        }
    }
    const double along = t + b;
    const double radius = std::sqrt(exponential());
    const double across = radius * std::cos(6.283185307179586 * double(random.next()));
    return glm::normalize(glm::vec3(float(_alpha.x * (x * along - y * across)),
                                    float(_alpha.y * (y * along + x * across)), 1.0f));
}

glm::vec3 SmithSurface::sampleVisibleNormal(const glm::vec3& v, const glm::vec2& u,
                                            HashedNumbers& random) const {
    if (_ndf == sh::NDF_BECKMANN && v.z < 0.0f) return beckmannFromBelow(v, random);
    return sh::microfacetSampleVisible(v, _alpha, u, _ndf);
}

double SmithSurface::reflected(const glm::vec3& v, const glm::vec3& i, float& cosine) const {
    glm::vec3 h = v + i;
    const float length = glm::length(h);
    if (!(length > 1e-6f) || !(h.z > 0.0f)) return 0.0;
    h /= length;
    cosine = std::min(0.5f * length, 1.0f);
    const double area = projectedArea(v);
    return area > 0.0 ? double(sh::microfacetD(h, _alpha, _ndf)) * 0.25 / area : 0.0;
}

double SmithSurface::refracted(const glm::vec3& v, const glm::vec3& i, float eta,
                               float& cosine) const {
    glm::vec3 h = v + i * eta;
    const float length = glm::length(h);
    if (!(length > 1e-6f)) return 0.0;
    h *= (h.z >= 0.0f ? 1.0f : -1.0f) / length;
    const float vh = glm::dot(v, h), ih = glm::dot(i, h);
    const double area = projectedArea(v);
    if (!(vh > 0.0f && ih < 0.0f) || !(area > 0.0)) return 0.0;
    cosine = std::min(vh, 1.0f);
    const double jacobian = double(eta) * eta * -ih / (double(length) * length);
    return double(sh::microfacetD(h, _alpha, _ndf)) * vh / area * jacobian;
}

} // namespace patina

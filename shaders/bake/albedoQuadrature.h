#pragma once

#include <vector>

#include "shaders/shaders.h"

namespace patina::bake {

/// Gauss-Legendre nodes and weights on [0, 1].
struct GaussRule {
    explicit GaussRule(int n);
    std::vector<double> x;
    std::vector<double> w;
};

/// What single scattering at the isotropic GGX interface does with light that arrives at cosine
/// `mu`: integrals over the visible normals, in the sampling square of ggxSampleVisible, with `n`
/// by `n` points. The azimuth is symmetric: half of it is enough. Points crowd where facets lean
/// far from the normal, since that tail alone decides how much light is lost at small roughness.
/// Along the other axis each column has two Gauss panels that meet at a place of its own, so that
/// kinks (the critical angle, the horizon) fall differently between the points of each column and
/// average out.
class InterfaceQuadrature {
public:
    explicit InterfaceQuadrature(int n) : _rule(n / 2), _columns(n) {}

    /// Calls fn(weight, c, wo, m) for every facet normal; the weights sum to 1, c = wo.m.
    template <typename Fn> void forEachNormal(double mu, double alpha, Fn&& fn) const {
        using namespace sh64;
        const vec3 wo(std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu);
        const std::size_t half = _rule.x.size();
        for (int i = 0; i < _columns; ++i) {
            const double golden = (i + 0.5) * 0.6180339887498949;
            const double cut = 0.2 + 0.6 * (golden - std::floor(golden));
            for (std::size_t j = 0; j < 2 * half; ++j) {
                const bool upper = j >= half;
                const double width = upper ? 1.0 - cut : cut;
                const double y = (upper ? cut : 0.0) + width * _rule.x[j % half];
                const double weight = 3.0 * y * y * width * _rule.w[j % half] / _columns;
                const vec2 u((i + 0.5) / (2.0 * _columns), 1.0 - y * y * y);
                const vec3 m =
                    alpha > 0.0 ? ggxSampleVisible(wo, vec2(alpha), u) : vec3(0.0, 0.0, 1.0);
                fn(weight, std::min(std::max(sh64::dot(wo, m), 0.0), 1.0), wo, m);
            }
        }
    }

    /// E[p](mu, alpha) for `count` exponents at once.
    void moments(double mu, double alpha, const double* exponents, int count, double* result) const;

    /// (reflected, transmitted) of a dielectric of relative ior `eta`.
    sh64::vec2 dielectric(double mu, double alpha, double eta) const;

private:
    GaussRule _rule;
    int _columns;
};

} // namespace patina::bake

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
/// `mu`. Integrals over the visible normals, by a product rule of `n` by `n` points in the sampling
/// square of ggxSampleVisible (the azimuth is symmetric: half of it is enough).
class InterfaceQuadrature {
public:
    explicit InterfaceQuadrature(int n) : _rule(n) {}

    /// Calls fn(weight, c, wo, m) for every facet normal; the weights sum to 1, c = wo.m.
    template <typename Fn> void forEachNormal(double mu, double alpha, Fn &&fn) const {
        using namespace sh64;
        const vec3 wo(std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu);
        const std::size_t n = _rule.x.size();
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < n; ++i) {
                const double y = _rule.x[j];
                const vec2 u((double(i) + 0.5) / double(2 * n), 1.0 - y * y * y);
                const vec3 m =
                    alpha > 0.0 ? ggxSampleVisible(wo, vec2(alpha), u) : vec3(0.0, 0.0, 1.0);
                fn(3.0 * y * y * _rule.w[j] / double(n),
                   std::min(std::max(sh64::dot(wo, m), 0.0), 1.0), wo, m);
            }
    }

    /// E[p](mu, alpha) for `count` exponents at once.
    void moments(double mu, double alpha, const double *exponents, int count, double *result) const;

    /// (reflected, transmitted) of a dielectric of relative ior `eta`.
    sh64::vec2 dielectric(double mu, double alpha, double eta) const;

private:
    GaussRule _rule;
};

} // namespace patina::bake

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "shaders/oracle.h"

namespace patina::bake {

/// Gauss-Legendre nodes and weights on [0, 1].
struct GaussRule {
    explicit GaussRule(int n);
    std::vector<double> x;
    std::vector<double> w;
};

/// Single scattering at a microfacet interface, of light from one direction: integrals over the
/// visible normals, in the sampling square of microfacetSampleVisible, with `n` by `n` points.
///
/// - Points are dense where facets of GGX lean far from the normal. That tail alone decides how
///   much light is lost at small roughness.
/// - Isotropic lobes are symmetric: half of the square is enough.
/// - Along one axis each column has two Gauss panels, which meet at another place in each column.
///   So kinks (the critical angle, the horizon) fall differently between the points of each column
///   and average out.
/// - Anisotropic lobes take a lattice, whose error is 3e-3 for `n` = 24.
class InterfaceQuadrature {
public:
    /// @param ndf sh::NDF_*
    InterfaceQuadrature(int n, int ndf) : _rule(n / 2), _columns(n), _ndf(ndf) {}

    /// Draws the normals that the other functions sum over. Mirrors (alpha 0) have one.
    void setView(sh64::vec3 wo, sh64::vec2 alpha);

    /// E[p] for `count` exponents at once.
    void moments(const double* exponents, int count, double* result) const;

    /// How the light that a mirror reflects is spread over wo.m, in `bins` even in the root of the
    /// cosine: the light and the mean cosine of each (0 where there is no light).
    void spread(int bins, double* light, double* cosine) const;

    /// (reflected, transmitted) of a dielectric of relative ior `eta`.
    sh64::vec2 dielectric(double eta) const;

private:
    struct Normal {
        sh64::vec3 m;
        double c;         ///< wo.m
        double weight;    ///< all sum to 1
        double reflected; ///< weight of what a mirror reflects
    };

    void lookAround();
    void add(sh64::vec2 u, double weight);

    GaussRule _rule;
    int _columns;
    int _ndf;
    sh64::vec3 _wo{0.0, 0.0, 1.0};
    sh64::vec2 _alpha{0.0, 0.0};
    double _length = 1.0; ///< microfacetLength of wo
    std::vector<Normal> _normals;
};

/// Direction at cosine `mu` and azimuth 0.
sh64::vec3 slanted(double mu);

} // namespace patina::bake

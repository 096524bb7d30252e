// SPDX-License-Identifier: Apache-2.0
// Writes what shaders/bake/albedoFit.py is fitted to: `microfacetCosines BINS MU ALPHA OUT`. For MU
// by ALPHA directions and roughnesses, the spread of the cosine between view and facet over the
// reflected light of an isotropic GGX mirror. From it the albedo under any reflectance is one sum.
//
// Doubles: BINS; then per place mu, alpha, the light in each bin, the mean cosine of each bin. Bins
// are even in the root of the cosine. MU and ALPHA below 0 mean cell centres of (mu, root of
// alpha), else nodes that reach the edges and crowd at grazing angles.

#include <cstdio>
#include <cstdlib>

#include "shaders/bake/albedoQuadrature.h"

using namespace patina;
using namespace patina::sh64;

namespace {

constexpr int pointCount = 160;
constexpr double grazing = 0.004;

vec2 centre(int m, int a, int mus, int alphas) {
    const double root = (a + 0.5) / alphas;
    return vec2((m + 0.5) / mus, root * root);
}

vec2 node(int m, int a, int mus, int alphas) {
    const double x = double(m) / (mus - 1);
    const double root0 = std::sqrt(double(ALPHA_MIRROR));
    const double root = root0 + (1.0 - root0) * a / (alphas - 1);
    return vec2(grazing + (1.0 - grazing) * x * x * (1.5 - 0.5 * x), root * root);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fprintf(stderr, "usage: microfacetCosines BINS MU ALPHA OUT\n");
        return 2;
    }
    const int bins = std::atoi(argv[1]);
    const int mus = std::atoi(argv[2]);
    const int alphas = std::atoi(argv[3]);
    std::FILE* out = std::fopen(argv[4], "wb");
    if (bins < 1 || !out) {
        std::fprintf(stderr, "microfacetCosines: no bins, or cannot write %s\n", argv[4]);
        return 1;
    }
    bake::InterfaceQuadrature quadrature(pointCount, NDF_GGX);
    std::vector<double> light(bins), cosine(bins);
    const double head = bins;
    std::fwrite(&head, sizeof head, 1, out);
    for (int a = 0; a < std::abs(alphas); ++a)
        for (int m = 0; m < std::abs(mus); ++m) {
            const vec2 p = mus < 0 ? centre(m, a, -mus, -alphas) : node(m, a, mus, alphas);
            quadrature.setView(bake::slanted(p.x), vec2(p.y));
            quadrature.spread(bins, light.data(), cosine.data());
            std::fwrite(&p, sizeof(double), 2, out);
            std::fwrite(light.data(), sizeof(double), light.size(), out);
            std::fwrite(cosine.data(), sizeof(double), cosine.size(), out);
        }
    return std::fclose(out) == 0 ? 0 : 1;
}

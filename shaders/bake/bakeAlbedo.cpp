// SPDX-License-Identifier: Apache-2.0
// Writes the directional albedo tables of shaders/lib/albedoTable.glsl: `bakeAlbedo OUT.cpp` makes
// the array that C++ links.

#include <cstdio>
#include <thread>

#include "shaders/bake/albedoQuadrature.h"

namespace {

// Filled entry by entry; later tables read earlier ones through the look-ups.
float entries[patina::sh64::ALBEDO_TABLE_SIZE];
int entryCount = 0;

void push(double value) {
    if (entryCount < patina::sh64::ALBEDO_TABLE_SIZE) entries[entryCount] = float(value);
    ++entryCount;
}

} // namespace

namespace patina {
const float* const patinaAlbedoTable = entries;
} // namespace patina

namespace {

using namespace patina;
using namespace patina::sh64;

// Points per side of the product rule.
constexpr int momentPoints = 64;
constexpr int abovePoints = 20;
// Total reflection has a kink; Beckmann facets have no tail and need fewer.
constexpr int belowPoints[] = {28, 20};
constexpr int turnedPoints[] = {24, 20};

// The entry for mu = 0 is taken at this fraction of the first cell: exactly at 0 the albedos jump.
constexpr double firstNode = 0.1;

// The tables of one distribution are written at `out`; the look-ups read what is there already.
void bakeMoments(int ndf, float* out) {
    bake::InterfaceQuadrature quadrature(momentPoints, ndf);
    double exponents[MOMENT_COUNT];
    for (int k = 0; k < MOMENT_COUNT; ++k)
        exponents[k] = momentExponent(k);
    for (int a = 0; a < MOMENT_ALPHA; ++a)
        for (int m = 0; m < MOMENT_MU; ++m) {
            double e[MOMENT_COUNT];
            const double alpha = tableAlphaAt(double(a) / (MOMENT_ALPHA - 1));
            const double mu = tableMuAt(std::max(double(m), firstNode) / (MOMENT_MU - 1), alpha);
            quadrature.setView(bake::slanted(mu), vec2(alpha));
            quadrature.moments(exponents, MOMENT_COUNT, e);
            *out++ = float(e[0]);
            for (int k = 1; k < MOMENT_COUNT; ++k)
                *out++ = float(std::pow(e[k] / e[0], 1.0 / exponents[k]) - (1.0 - mu));
        }
}

// From the thinner side the normals seen are the same for every ior, so that is the inner loop.
void bakeInterface(int ndf, bool above, float* out) {
    bake::InterfaceQuadrature quadrature(above ? abovePoints : belowPoints[ndf], ndf);
    for (int a = 0; a < INTERFACE_ALPHA; ++a)
        for (int m = 0; m < INTERFACE_MU; ++m)
            for (int i = 0; i < INTERFACE_ETA; ++i) {
                const double ior = tableEtaAt(double(i) / (INTERFACE_ETA - 1));
                const double eta = above ? ior : 1.0 / ior;
                const double alpha = tableAlphaAt(double(a) / (INTERFACE_ALPHA - 1));
                const double t = std::max(double(m), firstNode) / (INTERFACE_MU - 1);
                const double mu =
                    above ? tableMuAt(t, alpha) : tableMuBelowAt(t, tableMuCritical(eta), alpha);
                if (!above || i == 0) quadrature.setView(bake::slanted(mu), vec2(alpha));
                // Relative to what the look-up will multiply with, not to the exact E[0].
                const double e0 = momentEntry(momentPlace(mu, alpha, ndf * MICROFACET_SIZE), 0);
                const vec2 e = quadrature.dielectric(eta);
                float* entry = out + 2 * ((i * INTERFACE_ALPHA + a) * INTERFACE_MU + m);
                entry[0] = float(e.x / e0 - interfaceGuess(mu, alpha, eta));
                entry[1] = float(1.0 - (e.x + e.y) / e0);
            }
}

// A row of the tables of anisotropy.
struct TurnedNode {
    vec3 wo;
    vec2 alpha;
};

// view: mu and the cosine of the azimuth, from their coordinates, the larger alpha and the ratio.
template <typename View> TurnedNode turnedNode(int row, int alphas, const View& view) {
    const int m = row % TURNED_MU;
    const int c = row / TURNED_MU % TURNED_AZIMUTH;
    const int r = row / (TURNED_MU * TURNED_AZIMUTH) % TURNED_RATIO;
    const int a = row / (TURNED_MU * TURNED_AZIMUTH * TURNED_RATIO);
    const double larger = tableAlphaAt(double(a) / (alphas - 1));
    const double ratio = turnedRatioAt(double(r) / (TURNED_RATIO - 1));
    const double t = std::max(double(m), firstNode) / (TURNED_MU - 1);
    const vec2 at = view(t, double(c) / (TURNED_AZIMUTH - 1), larger, ratio);
    const double s = std::sqrt(std::max(0.0, 1.0 - at.x * at.x));
    return {vec3(s * at.y, s * std::sqrt(1.0 - at.y * at.y), at.x),
            vec2(larger, std::max(larger * ratio, double(ALPHA_MIRROR)))};
}

vec2 viewAbove(double mu, double azimuth, double larger, double ratio) {
    const double c = turnedAzimuthAt(ratio, azimuth);
    return vec2(tableMuAt(mu, turnedAlpha(larger, ratio, c)), c);
}

void bakeTurnedMoments(int ndf, float* out) {
    bake::InterfaceQuadrature quadrature(turnedPoints[ndf], ndf);
    double exponents[MOMENT_COUNT];
    for (int k = 0; k < MOMENT_COUNT; ++k)
        exponents[k] = momentExponent(k);
    for (int row = 0; row < turnedRow(TURNED_ALPHA, 0, 0, 0); ++row, out += MOMENT_COUNT) {
        const TurnedNode node = turnedNode(row, TURNED_ALPHA, viewAbove);
        if (node.alpha.x == node.alpha.y) continue; // nothing to add
        double e[MOMENT_COUNT];
        quadrature.setView(node.wo, node.alpha);
        quadrature.moments(exponents, MOMENT_COUNT, e);
        const MomentPlace same =
            momentPlace(node.wo.z, microfacetAlphaSeen(node.wo, node.alpha), ndf * MICROFACET_SIZE);
        out[0] = float(e[0] - momentEntry(same, 0));
        for (int k = 1; k < MOMENT_COUNT; ++k)
            out[k] = float(std::pow(e[k] / e[0], 1.0 / exponents[k]) - (1.0 - node.wo.z) -
                           momentEntry(same, k));
    }
}

void bakeTurnedInterface(int ndf, bool above, float* out) {
    bake::InterfaceQuadrature quadrature(turnedPoints[ndf], ndf);
    const int rows = turnedRow(TURNED_ETA_ALPHA, 0, 0, 0);
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < TURNED_ETA; ++i) {
            const double ior = tableEtaAt(double(i) / (TURNED_ETA - 1));
            const double eta = above ? ior : 1.0 / ior;
            const auto below = [&](double mu, double azimuth, double larger, double ratio) {
                const double width = turnedAlpha(larger, ratio, turnedBeyond(azimuth));
                const double z = tableMuBelowAt(mu, tableMuCritical(eta), width);
                return vec2(z, turnedBelowAt(z, eta, azimuth));
            };
            const TurnedNode node = above ? turnedNode(row, TURNED_ETA_ALPHA, viewAbove)
                                          : turnedNode(row, TURNED_ETA_ALPHA, below);
            if (node.alpha.x == node.alpha.y) continue; // nothing to add
            if (!above || i == 0) quadrature.setView(node.wo, node.alpha);
            const MicrofacetPlace place = microfacetPlace(node.wo, node.alpha, ndf);
            const double e0 = microfacetAlbedo0(place);
            const vec2 e = quadrature.dielectric(eta);
            const vec2 same = interfaceEntry(place.mu, place.alpha, eta, ndf);
            float* entry = out + 2 * (i * rows + row);
            entry[0] = float(e.x / e0 - interfaceGuess(place.mu, place.alpha, eta) - same.x);
            entry[1] = float(1.0 - (e.x + e.y) / e0 - same.y);
        }
}

void bakeMicrofacets(int ndf) {
    float* const table = entries + ndf * MICROFACET_SIZE;
    bakeMoments(ndf, table);
    bakeInterface(ndf, true, table + INTERFACE_ABOVE);
    bakeInterface(ndf, false, table + INTERFACE_BELOW);
    bakeTurnedMoments(ndf, table + TURNED_MOMENT);
    bakeTurnedInterface(ndf, true, table + TURNED_ABOVE);
    bakeTurnedInterface(ndf, false, table + TURNED_BELOW);
}

// Sheen is as wide as the hemisphere or hugs the horizon: a plain product rule, dense there.
void bakeSheen() {
    const bake::GaussRule rule(48);
    const int turns = 64;
    for (int r = 0; r < SHEEN_ROUGHNESS; ++r)
        for (int m = 0; m < SHEEN_MU; ++m) {
            const double roughness = sheenRoughnessAt(double(r) / (SHEEN_ROUGHNESS - 1));
            const double mu = sheenMuAt(double(m) / (SHEEN_MU - 1));
            const vec3 wo(std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu);
            double sum = 0.0;
            for (std::size_t i = 0; i < rule.x.size(); ++i)
                for (int j = 0; j < turns; ++j) {
                    const double z = rule.x[i] * rule.x[i];
                    const double s = std::sqrt(1.0 - z * z);
                    const double phi = sh64::PI * (j + 0.5) / turns;
                    const vec3 wi(s * std::cos(phi), s * std::sin(phi), z);
                    sum += rule.w[i] * 2.0 * rule.x[i] * sheenContyKulla(roughness, wo, wi).x;
                }
            push(sum * 2.0 * sh64::PI / turns);
        }
}

// Mean weight of a lobe's own sampler over a product rule whose columns are shifted against each
// other, so that the edge at the horizon averages out.
template <typename Sample> double meanWeight(int n, const Sample& sample) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double shift = (i + 0.5) * 0.6180339887498949;
            sum += sample((i + 0.5) / n, (j + shift - std::floor(shift)) / n);
        }
    return sum / (double(n) * n);
}

void bakeClassic(int plane) {
    for (int a = 0; a < CLASSIC_ALPHA; ++a)
        for (int m = 0; m < CLASSIC_MU; ++m) {
            const double alpha = tableAlphaAt(double(a) / (CLASSIC_ALPHA - 1));
            const double mu = tableMuAt(std::max(double(m), firstNode) / (CLASSIC_MU - 1), alpha);
            const vec3 wo(std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu);
            const PhongLobe phong = phongSetup(vec3(1.0), phongExponent(alpha));
            const BlinnPhongLobe blinn = blinnPhongSetup(vec3(1.0), phongExponent(alpha));
            const WardLobe ward = wardSetup(
                vec3(1.0), vec2(alpha), plane == CLASSIC_WARD_EXACT ? WARD_EXACT : WARD_BOUNDED);
            push(meanWeight(64, [&](double x, double y) {
                const vec3 u(x, y, 0.5);
                if (plane == CLASSIC_PHONG) return phongSample(phong, wo, u).weight.x;
                if (plane == CLASSIC_BLINN_PHONG) return blinnPhongSample(blinn, wo, u).weight.x;
                return wardSample(ward, wo, u).weight.x;
            }));
        }
}

void bakeTurnedWard(int plane) {
    const int form = plane == CLASSIC_WARD_EXACT ? WARD_EXACT : WARD_BOUNDED;
    for (int row = 0; row < WARD_SIZE; ++row) {
        const TurnedNode node = turnedNode(row, TURNED_ALPHA, viewAbove);
        if (node.alpha.x == node.alpha.y) { // nothing to add
            push(0.0);
            continue;
        }
        const WardLobe ward = wardSetup(vec3(1.0), node.alpha, form);
        const double e = meanWeight(64, [&](double x, double y) {
            return wardSample(ward, node.wo, vec3(x, y, 0.5)).weight.x;
        });
        push(e - classicAlbedo(plane, node.wo.z, microfacetAlphaSeen(node.wo, node.alpha)));
    }
}

// Moments of the V-cavity lobe, over both facets of each cavity.
void bakeVCavity() {
    for (int a = 0; a < MOMENT_ALPHA; ++a)
        for (int m = 0; m < MOMENT_MU; ++m) {
            const double alpha = tableAlphaAt(double(a) / (MOMENT_ALPHA - 1));
            const double mu = tableMuAt(std::max(double(m), firstNode) / (MOMENT_MU - 1), alpha);
            const vec3 wo(std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu);
            double e[MOMENT_COUNT] = {};
            meanWeight(32, [&](double x, double y) {
                const vec3 first = beckmannSample(alpha, vec2(x, y));
                const vec3 normals[] = {first, vec3(-first.x, -first.y, first.z)};
                const double seen[] = {std::max(sh64::dot(wo, normals[0]), 0.0),
                                       std::max(sh64::dot(wo, normals[1]), 0.0)};
                for (int k = 0; k < 2; ++k) {
                    const double c = seen[k];
                    const double iz = 2.0 * c * normals[k].z - mu;
                    if (c <= 0.0 || iz <= 0.0) continue;
                    const double mz = normals[k].z;
                    const double weight = c / (seen[0] + seen[1]) * vCavityBoth(mu, iz, c, mz) /
                                          vCavityVisible(mu, c, mz);
                    for (int p = 0; p < MOMENT_COUNT; ++p)
                        e[p] += weight * powSchlick(1.0 - std::min(c, 1.0), momentExponent(p));
                }
                return 0.0;
            });
            push(e[0] / (32.0 * 32.0));
            for (int k = 1; k < MOMENT_COUNT; ++k)
                push(std::pow(e[k] / e[0], 1.0 / momentExponent(k)) - (1.0 - mu));
        }
}

// Transforms of what the channels see, at even path differences.
void bakeFilm() {
    for (int i = 0; i < FILM_PATHS; ++i) {
        const double path = double(FILM_PATH_MAX) * i / (FILM_PATHS - 1);
        vec3 re(0.0), im(0.0), white(0.0);
        for (double nm = 360.0; nm <= 830.0; nm += 1.0) {
            const double phase = 2e3 * sh64::PI * path / nm;
            const vec3 seen = filmChannels(nm);
            re += seen * std::cos(phase);
            im += seen * std::sin(phase);
            white += seen;
        }
        // At the last entry nothing is left, for all paths beyond.
        const double left = i + 1 < FILM_PATHS ? 1.0 : 0.0;
        for (const vec3& v : {re / white, im / white})
            for (int k = 0; k < 3; ++k)
                push(left * v[k]);
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: bakeAlbedo OUT.cpp\n");
        return 2;
    }
    std::thread beckmann(bakeMicrofacets, NDF_BECKMANN);
    bakeMicrofacets(NDF_GGX);
    beckmann.join();
    entryCount = 2 * MICROFACET_SIZE;
    bakeSheen();
    for (int plane = CLASSIC_PHONG; plane <= CLASSIC_WARD_EXACT; ++plane)
        bakeClassic(plane);
    bakeVCavity();
    bakeFilm();
    bakeTurnedWard(CLASSIC_WARD_BOUNDED);
    bakeTurnedWard(CLASSIC_WARD_EXACT);
    if (entryCount != ALBEDO_TABLE_SIZE) {
        std::fprintf(stderr, "bakeAlbedo: %d entries, the layout has %d\n", entryCount,
                     ALBEDO_TABLE_SIZE);
        return 1;
    }
    std::FILE* out = std::fopen(argv[1], "w");
    if (!out) {
        std::fprintf(stderr, "bakeAlbedo: cannot write %s\n", argv[1]);
        return 1;
    }
    std::fprintf(out, "// Generated by shaders/bake/bakeAlbedo.cpp.\n"
                      "#include \"shaders/shaders.h\"\n\n"
                      "static const float entries[] = {\n");
    for (int i = 0; i < entryCount; ++i)
        std::fprintf(out, "%.7g%s", double(entries[i]), i % 12 == 11 ? ",\n" : ",");
    std::fprintf(out, "};\n\nnamespace patina {\n"
                      "const float *const patinaAlbedoTable = entries;\n"
                      "} // namespace patina\n");
    return std::fclose(out) == 0 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
#include "shaders/tests/chiSquared.h"

#include <random>

#include "shaders/tests/pearson.h"

namespace patina::test {

namespace {

// Integral of the density over a rectangle in (z, phi): tensor Gauss rule, cut in four until the
// parts agree with the whole.
class Integrator {
public:
    Integrator(const BoundLobe& lobe, vec3 wo) : _lobe(lobe), _wo(wo) {}

    double operator()(double z0, double z1, double p0, double p1) const {
        const double whole = rule(z0, z1, p0, p1);
        // A cell with a peak in it is cut before it is trusted. So is one at the horizon, where
        // densities may rise without bound, and one that seems empty, which may have something in a
        // corner.
        const bool odd = z0 == 0.0 || z1 == 0.0 || whole == 0.0;
        return refine(z0, z1, p0, p1, whole, whole > 5e-3 ? -3 : odd ? -1 : 0);
    }

private:
    double rule(double z0, double z1, double p0, double p1) const {
        static const double x[] = {0.069431844202973714, 0.33000947820757187};
        static const double w[] = {0.17392742256872693, 0.32607257743127307};
        double cosine[4], sine[4];
        for (int j = 0; j < 4; ++j) {
            const double p = p0 + (j < 2 ? x[j] : 1.0 - x[3 - j]) * (p1 - p0);
            cosine[j] = std::cos(p);
            sine[j] = std::sin(p);
        }
        double sum = 0.0;
        for (int i = 0; i < 4; ++i) {
            const double z = z0 + (i < 2 ? x[i] : 1.0 - x[3 - i]) * (z1 - z0);
            const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
            for (int j = 0; j < 4; ++j)
                sum += w[std::min(i, 3 - i)] * w[std::min(j, 3 - j)] *
                       _lobe.eval(_wo, vec3(r * cosine[j], r * sine[j], z)).pdf;
        }
        return sum * (z1 - z0) * (p1 - p0);
    }

    double refine(double z0, double z1, double p0, double p1, double whole, int depth) const {
        const double z = 0.5 * (z0 + z1);
        const double p = 0.5 * (p0 + p1);
        const double a = rule(z0, z, p0, p);
        const double b = rule(z, z1, p0, p);
        const double c = rule(z0, z, p, p1);
        const double d = rule(z, z1, p, p1);
        const double parts = a + b + c + d;
        // Cells that are smooth end with the first cut, which has to agree more closely.
        const double tolerance = (2e-7 + 1e-4 * whole) * (depth < 1 ? 0.05 : 1.0);
        if (depth >= 9 || (depth >= 0 && std::fabs(parts - whole) < tolerance)) return parts;
        return refine(z0, z, p0, p, a, depth + 1) + refine(z, z1, p0, p, b, depth + 1) +
               refine(z0, z, p, p1, c, depth + 1) + refine(z, z1, p, p1, d, depth + 1);
    }

    const BoundLobe& _lobe;
    vec3 _wo;
};

} // namespace

DensityGrid::DensityGrid(const BoundLobe& lobe, vec3 wo) {
    const Integrator integrate(lobe, wo);
    const double height = 2.0 / rowCount;
    const double width = 2.0 * sh64::PI / columnCount;
    for (int r = 0; r < rowCount; ++r)
        for (int c = 0; c < columnCount; ++c) {
            // The row across the horizon is cut there: densities jump at it.
            const double z0 = -1.0 + r * height;
            const double z1 = z0 + height;
            const double p0 = c * width;
            double& cell = _cells[r * columnCount + c];
            if (z0 < 0.0 && z1 > 0.0)
                cell = integrate(z0, 0.0, p0, p0 + width) + integrate(0.0, z1, p0, p0 + width);
            else
                cell = integrate(z0, z1, p0, p0 + width);
            _total += cell;
        }
}

ChiSquared DensityGrid::test(const BoundLobe& sampler, vec3 wo, int count,
                             std::uint64_t seed) const {
    std::mt19937_64 engine(seed);
    const auto uniform = [&] { return double(engine() >> 40) * 0x1p-24; };
    std::vector<double> histogram(rowCount * columnCount, 0.0);
    ChiSquared result;
    for (int i = 0; i < count; ++i) {
        const double x = uniform();
        const double y = uniform();
        const sh64::LobeSample s = sampler.sample(wo, vec3(x, y, uniform()));
        if (s.event == 0 || (s.event & sh::LOBE_DELTA) != 0) continue;
        const int r = std::clamp(int((s.wi.z + 1.0) * 0.5 * rowCount), 0, rowCount - 1);
        double turn = std::atan2(s.wi.y, s.wi.x) / (2.0 * sh64::PI);
        turn -= std::floor(turn);
        histogram[r * columnCount + std::min(int(turn * columnCount), columnCount - 1)] += 1.0;
        result.hits += 1.0 / count;
    }
    // Cells that expect fewer than 5 samples are pooled, smallest first.
    std::vector<int> order(rowCount * columnCount);
    for (int i = 0; i < rowCount * columnCount; ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](int a, int b) { return _cells[a] < _cells[b]; });
    Pearson found;
    double pooledExpected = 0.0;
    double pooledCount = 0.0;
    const auto close = [&] {
        found.add(pooledExpected, pooledCount);
        pooledExpected = pooledCount = 0.0;
    };
    for (int i : order) {
        if (_cells[i] == 0.0 && histogram[i] > 0.0) result.stray = true;
        pooledExpected += _cells[i] * count;
        pooledCount += histogram[i];
        if (pooledExpected >= 5.0) close();
    }
    // Samples that found no direction, or a delta one, are a cell of their own.
    const double missing = (1.0 - _total) * count;
    if (missing >= 2e-3 * count) {
        pooledExpected += missing;
        pooledCount += (1.0 - result.hits) * count;
        close();
    }
    result.expected = _total;
    result.cells = found.cells();
    result.pValue = found.tail();
    return result;
}

} // namespace patina::test

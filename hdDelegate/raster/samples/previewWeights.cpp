// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/samples/previewWeights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patina {

namespace {

constexpr size_t count = 9;
using Vector = std::array<double, count>;

/// Up to factors, of which the solution does not depend but for rounding.
Vector harmonics(const glm::dvec3& d) {
    return {1.0,
            d.x,
            d.y,
            d.z,
            d.x * d.y,
            d.y * d.z,
            d.x * d.z,
            d.x * d.x - d.y * d.y,
            3.0 * d.z * d.z - 1.0};
}

/// Solves a x = b for a symmetric positive definite a, by Cholesky's factors.
Vector solve(std::array<Vector, count> a, Vector b) {
    for (size_t i = 0; i < count; ++i) {
        for (size_t j = 0; j <= i; ++j) {
            double sum = a[i][j];
            for (size_t k = 0; k < j; ++k)
                sum -= a[i][k] * a[j][k];
            a[i][j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / a[j][j];
        }
        for (size_t k = 0; k < i; ++k)
            b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (size_t i = count; i-- > 0;) {
        for (size_t k = i + 1; k < count; ++k)
            b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return b;
}

} // namespace

std::vector<glm::vec3> previewWeights(const std::vector<DomeSample>& few,
                                      const std::vector<DomeSample>& all) {
    std::vector<glm::vec3> out(few.size(), glm::vec3(1.0f));
    if (few.size() < 2 * count || all.size() <= few.size()) return out;
    for (int c = 0; c < 3; ++c) {
        const auto meanOf = [&](const std::vector<DomeSample>& samples) {
            Vector sum{};
            for (const DomeSample& s : samples) {
                const Vector y = harmonics(s.direction);
                for (size_t i = 0; i < count; ++i)
                    sum[i] += double(s.light[c]) * y[i] / double(samples.size());
            }
            return sum;
        };
        // The least change of factors: they differ from 1 by what the harmonics explain of the
        // light.
        Vector missing = meanOf(all);
        const Vector have = meanOf(few);
        std::array<Vector, count> products{};
        for (const DomeSample& s : few) {
            const Vector y = harmonics(s.direction);
            const double light = double(s.light[c]);
            for (size_t i = 0; i < count; ++i)
                for (size_t j = 0; j < count; ++j)
                    products[i][j] += light * light * y[i] * y[j] / double(few.size());
        }
        double trace = 0.0;
        for (size_t i = 0; i < count; ++i) {
            missing[i] -= have[i];
            trace += products[i][i];
        }
        if (!(trace > 0.0) || !std::isfinite(trace)) continue;
        for (size_t i = 0; i < count; ++i)
            products[i][i] += 1e-3 * trace / double(count); // few directions may be alike
        const Vector x = solve(products, missing);
        for (size_t k = 0; k < few.size(); ++k) {
            const Vector y = harmonics(few[k].direction);
            double factor = 1.0;
            for (size_t i = 0; i < count; ++i)
                factor += double(few[k].light[c]) * y[i] * x[i];
            out[k][c] = float(std::clamp(factor, 0.2, 5.0));
        }
    }
    return out;
}

} // namespace patina

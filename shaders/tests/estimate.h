// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace patina::test {

constexpr double pi = 3.14159265358979323846;

/// Mean of random numbers, and how far it may be off.
struct Mean {
    double sum = 0.0, squares = 0.0;
    int count = 0;

    void add(double x) {
        sum += x;
        squares += x * x;
        ++count;
    }
    double mean() const { return sum / count; }
    /// Of one of the numbers.
    double deviation() const {
        const double m = mean();
        return std::sqrt(std::max(squares / count - m * m, 0.0));
    }
    /// The mean's standard error.
    double error() const { return deviation() / std::sqrt(double(count)); }
    double variance() const { return error() * error(); }
};

/// An estimate passes when it is within this many standard errors: two-sided significance 7e-6.
constexpr double sigmas = 4.5;

inline testing::AssertionResult agree(const Mean& e, double exact, double slack = 0.0) {
    if (std::abs(e.mean() - exact) <= sigmas * e.error() + slack * std::abs(exact) + 1e-12)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << e.mean() << " +- " << e.error() << ", exactly " << exact;
}

inline testing::AssertionResult agree(const Mean& a, const Mean& b) {
    const double error = std::hypot(a.error(), b.error());
    if (std::abs(a.mean() - b.mean()) <= sigmas * error + 1e-9) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << a.mean() << " +- " << a.error() << " and " << b.mean() << " +- " << b.error();
}

template <class Draw> Mean estimate(int count, const Draw& draw) {
    Mean mean;
    for (int i = 0; i < count; ++i)
        mean.add(draw());
    return mean;
}

/// Numbers from 0 to 1 that are the same everywhere.
class Random {
public:
    explicit Random(std::uint32_t seed) : _engine(seed) {}
    float operator()() { return float(_engine() >> 8) * 0x1p-24f; }
    glm::vec2 square() {
        const float x = (*this)();
        return {x, (*this)()};
    }
    glm::vec3 cube() {
        const glm::vec2 u = square();
        return {u, (*this)()};
    }
    /// Uniform on the sphere.
    glm::vec3 direction() {
        const float z = 1.0f - 2.0f * (*this)(), phi = 2.0f * float(pi) * (*this)();
        const float s = std::sqrt(std::max(0.0f, 1.0f - z * z));
        return {s * std::cos(phi), s * std::sin(phi), z};
    }

private:
    std::mt19937 _engine;
};

} // namespace patina::test

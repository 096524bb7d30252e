#pragma once

#include "materialNetwork/tests/materialTest.h"

#include <cmath>

namespace patina {

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
    /// Variance of the mean.
    double variance() const {
        const double m = mean();
        return std::max(squares / count - m * m, 0.0) / count;
    }
};

/// @returns how many standard errors two means lie apart
inline double deviations(const Mean& a, const Mean& b) {
    const double sigma = std::sqrt(a.variance() + b.variance());
    const double gap = std::fabs(a.mean() - b.mean());
    return gap < 1e-9 ? 0.0 : gap / std::max(sigma, 1e-12);
}

/// Light by cells of the sphere: 8 in height by 4 around.
struct Cells {
    static constexpr int count = 32;
    Mean cell[count];

    static int of(const glm::vec3& w) {
        const int row = std::min(std::max(int((w.z * 0.5f + 0.5f) * 8.0f), 0), 7);
        const int column = int((std::atan2(w.y, w.x) / 6.2831853f + 0.5f) * 4.0f);
        return row * 4 + std::min(std::max(column, 0), 3);
    }
    void add(const glm::vec3& w, double value) {
        const int at = of(w);
        for (int i = 0; i < count; ++i)
            cell[i].add(i == at ? value : 0.0);
    }
};

/// Most standard errors that any cell lies apart, of those that more than 20 samples fall into; a
/// normal distribution is none of fewer.
inline double deviations(const Cells& sampled, const Cells& evaluated) {
    double most = 0.0;
    for (int i = 0; i < Cells::count; ++i) {
        const Mean& cell = sampled.cell[i];
        const double larger = std::max(cell.mean(), evaluated.cell[i].mean());
        if (larger * cell.count > 20.0) most = std::max(most, deviations(cell, evaluated.cell[i]));
    }
    return most;
}

/// What samples of a material find, by where they go, without mirrors.
inline Cells sampledCells(const MaterialProgram& program, const glm::vec3& wo, int samples,
                          uint32_t seed) {
    ShadingPoint point;
    point.viewDirection = wo;
    Random random(seed);
    Cells cells;
    for (int i = 0; i < samples; ++i) {
        Bsdf bsdf;
        program.evaluate(point, bsdf);
        bsdf.seed(uint32_t(i));
        const glm::vec3 u = random.next3();
        const BsdfSample s = bsdf.sample(u, random.next());
        const bool counts = s.event != 0 && (s.event & sh::LOBE_DELTA) == 0;
        cells.add(counts ? s.wi : glm::vec3(0, 0, 1), counts ? double(s.weight.x) : 0.0);
    }
    return cells;
}

/// The same by values in random directions.
inline Cells evaluatedCells(const MaterialProgram& program, const glm::vec3& wo, int samples,
                            uint32_t seed) {
    ShadingPoint point;
    point.viewDirection = wo;
    Random random(seed);
    Cells cells;
    for (int i = 0; i < samples; ++i) {
        Bsdf bsdf;
        program.evaluate(point, bsdf);
        bsdf.seed(uint32_t(i));
        const glm::vec3 wi = random.direction();
        const BsdfEval e = bsdf.eval(wi);
        cells.add(wi, double(e.diffuse.x + e.specular.x) * 12.566370614359172);
    }
    return cells;
}

} // namespace patina

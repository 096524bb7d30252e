// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/tests/materialFixture.h"

namespace patina {

using test::Mean;

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
    double maximum = 0.0;
    for (int i = 0; i < Cells::count; ++i) {
        const Mean& cell = sampled.cell[i];
        const double larger = std::max(cell.mean(), evaluated.cell[i].mean());
        if (larger * cell.count > 20.0)
            maximum = std::max(maximum, deviations(cell, evaluated.cell[i]));
    }
    return maximum;
}

inline std::shared_ptr<const MaterialProgram> compiled(const Network& network,
                                                       const MethodChoices& methods) {
    static FakeTextures textures;
    Diagnostics diagnostics;
    return compileMaterial(network, textures, diagnostics, methods);
}

/// Calls visit with the lobes that a view sees, once per seed.
template <class Visit> void forSeeds(const MaterialProgram& program, const glm::vec3& wo,
                                     int samples, const Visit& visit) {
    const ShadingPoint point = seenFrom(wo);
    for (int i = 0; i < samples; ++i) {
        Bsdf bsdf = lobesAt(program, point);
        bsdf.seed(uint32_t(i));
        visit(bsdf);
    }
}

inline BsdfSample drawn(const Bsdf& bsdf, Random& random) {
    const glm::vec3 u = random.next3();
    return bsdf.sample(u, random.next());
}

/// Mean weight of samples.
inline Mean sampledAlbedo(const MaterialProgram& program, const glm::vec3& wo, int samples) {
    Random random(7);
    Mean mean;
    forSeeds(program, wo, samples, [&](const Bsdf& bsdf) {
        const BsdfSample s = drawn(bsdf, random);
        mean.add(s.event ? double(s.weight.x) : 0.0);
    });
    return mean;
}

/// Of samples that are no mirror's, density and weight are those of eval().
/// @returns whether there was one
inline bool expectSampleIsOfEval(const Bsdf& bsdf, Random& random, float tolerance) {
    const BsdfSample s = drawn(bsdf, random);
    if (s.event == 0 || (s.event & sh::LOBE_DELTA) != 0) return false;
    const BsdfEval e = bsdf.eval(s.wi);
    EXPECT_NEAR(s.pdf / e.pdf, 1.0f, tolerance);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(s.weight[k], (e.diffuse + e.specular)[k] / e.pdf,
                    tolerance * (1.0f + s.weight[k]));
    return true;
}

/// From random views, values in a random direction are finite, with a density that is positive
/// where they are, and so are samples.
inline void expectSound(const MaterialProgram& program, Random& random, int views) {
    for (int i = 0; i < views; ++i) {
        Bsdf bsdf = lobesAt(program, seenFrom(random.direction()));
        bsdf.seed(uint32_t(i));
        const BsdfEval e = bsdf.eval(random.direction());
        const float value = e.diffuse.x + e.specular.x;
        ASSERT_TRUE(std::isfinite(value) && std::isfinite(e.pdf) && value >= 0.0f);
        EXPECT_TRUE(value == 0.0f || e.pdf > 0.0f) << value << " " << e.pdf;
        const BsdfSample s = drawn(bsdf, random);
        ASSERT_TRUE(std::isfinite(s.weight.x) && std::isfinite(s.pdf));
    }
}

/// Weights of samples of a material, binned by direction, without mirrors.
inline Cells sampledCells(const MaterialProgram& program, const glm::vec3& wo, int samples,
                          uint32_t seed) {
    Random random(seed);
    Cells cells;
    forSeeds(program, wo, samples, [&](const Bsdf& bsdf) {
        const BsdfSample s = drawn(bsdf, random);
        const bool counts = s.event != 0 && (s.event & sh::LOBE_DELTA) == 0;
        cells.add(counts ? s.wi : glm::vec3(0, 0, 1), counts ? double(s.weight.x) : 0.0);
    });
    return cells;
}

/// The same by values in random directions.
inline Cells evaluatedCells(const MaterialProgram& program, const glm::vec3& wo, int samples,
                            uint32_t seed) {
    Random random(seed);
    Cells cells;
    forSeeds(program, wo, samples, [&](const Bsdf& bsdf) {
        const glm::vec3 wi = random.direction();
        const BsdfEval e = bsdf.eval(wi);
        cells.add(wi, double(e.diffuse.x + e.specular.x) * 12.566370614359172);
    });
    return cells;
}

/// No cell may be further off than 4.6 standard errors: of 32 cells that happens by chance once in
/// 7000 times, and numbers are the same in every run. Takes two seeds from `seed` on.
inline void expectSamplesAndValuesAgree(const MaterialProgram& program, const glm::vec3& wo,
                                        const char* what, int samples, uint32_t seed) {
    const Cells sampled = sampledCells(program, wo, samples, seed);
    const Cells evaluated = evaluatedCells(program, wo, samples, seed + 1);
    EXPECT_LT(deviations(sampled, evaluated), 4.6) << what;
}

} // namespace patina

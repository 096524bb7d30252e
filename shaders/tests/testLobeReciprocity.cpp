// SPDX-License-Identifier: Apache-2.0
// Lobes that are declared reciprocal are, in the flux form of refraction (each side weighted by its
// ior squared); the energy factor breaks it, and is declared to.

#include <cmath>

#include <gtest/gtest.h>

#include "shaders/tests/lobeCase.h"

using namespace patina;
using namespace patina::test;

namespace {

// Largest relative difference between both ways over a set of direction pairs.
double asymmetry(const LobeCase& c) {
    double worst = 0.0;
    for (int i = 0; i < 500; ++i) {
        const vec3 u = quasiRandom(i);
        const vec3 v = quasiRandom(i + 7000);
        const vec3 o = direction(c.twoSided ? 2.0 * u.x - 1.0 : u.x, 6.2831853 * u.y);
        vec3 w = direction(c.twoSided ? 2.0 * v.x - 1.0 : v.x, 6.2831853 * v.y);
        if (i % 2 == 0) {
            const sh64::LobeSample s = c.f64.sample(o, v);
            if (s.event == 0) continue;
            w = s.wi;
        }
        const double no = o.z >= 0.0 ? 1.0 : c.ior;
        const double nw = w.z >= 0.0 ? 1.0 : c.ior;
        const vec3 there = c.f64.eval(o, w).value / std::fabs(w.z) * (no * no);
        const vec3 back = c.f64.eval(w, o).value / std::fabs(o.z) * (nw * nw);
        for (int k = 0; k < 3; ++k) {
            const double sum = there[k] + back[k];
            if (sum > 1e-6) worst = std::max(worst, std::fabs(there[k] - back[k]) / sum);
        }
    }
    return worst;
}

} // namespace

TEST(LobeReciprocity, BareLobesAreReciprocal) {
    for (const LobeCase& c : lobeCases(0)) {
        // The ior of a Schlick lobe is known to float precision only.
        if (c.reciprocal)
            EXPECT_LT(asymmetry(c), 1e-6) << c.name;
        else
            EXPECT_GT(asymmetry(c), 1e-3) << c.name << ": declared not to be";
    }
}

TEST(LobeReciprocity, EnergyFactorBreaksIt) {
    int checked = 0;
    for (const LobeCase& c : lobeCases(1))
        if (!c.reciprocal && c.alpha > 0.9 && c.name.find("zeltner") != 0) {
            EXPECT_GT(asymmetry(c), 1e-3) << c.name;
            ++checked;
        }
    EXPECT_GT(checked, 0);
}

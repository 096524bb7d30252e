// SPDX-License-Identifier: Apache-2.0
// Lobes that are declared reciprocal are, in the flux form of refraction (each side weighted by its
// ior squared); the energy factor breaks it, and is declared to.

#include <gtest/gtest.h>

#include "shaders/tests/lobeCase.h"

using namespace patina;
using namespace patina::test;

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

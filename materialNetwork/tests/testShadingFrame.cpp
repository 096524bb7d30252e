// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/tests/materialFixture.h"

#include "shaders/closure.h"

#include <gtest/gtest.h>

using namespace patina;

namespace {

/// sh::bendNormal() by its words, in double.
glm::dvec3 bent(glm::dvec3 n, const glm::dvec3& v, const glm::dvec3& g) {
    const double margin = 1e-3;
    if (glm::dot(n, v) <= 0.0) n = glm::normalize(n + v * (margin - glm::dot(n, v)));
    const glm::dvec3 mirror = n * (2.0 * glm::dot(n, v)) - v;
    const double wanted = std::min(margin, glm::dot(v, g));
    const double above = glm::dot(mirror, g);
    if (above >= wanted) return n;
    return glm::normalize(v + glm::normalize(mirror + g * (wanted - above)));
}

} // namespace

// A sine of 1e-3 has 1e-4 of its value as the rounding of unit vectors; what a lobe makes of it, as
// much. Sums of nearly opposite directions left ten times that, and more.
TEST(ShadingFrame, TurnedNormalsAreExactAtGrazingAngles) {
    Random random(3);
    int turned = 0;
    for (int i = 0; i < 2000; ++i) {
        const float sine = std::pow(10.0f, -3.5f + 3.0f * random.next());
        const float phi = 6.2831853f * random.next();
        const glm::vec3 g(0, 0, 1);
        const glm::vec3 v = glm::normalize(glm::vec3(std::cos(phi), std::sin(phi), sine));
        const glm::vec3 n = direction(89.0f * random.next(), 360.0f * random.next());
        const glm::dvec3 expected =
            bent(glm::normalize(glm::dvec3(n)), glm::normalize(glm::dvec3(v)), g);
        const glm::vec3 found = sh::bendNormal(n, v, g);
        turned += glm::length(expected - glm::dvec3(n)) > 1e-3;
        const double seen = glm::dot(expected, glm::normalize(glm::dvec3(v)));
        EXPECT_NEAR(glm::dot(glm::dvec3(found), glm::dvec3(v)), seen, 1e-3 * seen + 5e-7)
            << i << " sine " << sine;
    }
    EXPECT_GT(turned, 500);
}

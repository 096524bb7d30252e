// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/tests/statistics.h"
#include "shaders/oracle.h"

namespace patina {

inline NetworkNode interfaceNode(const std::string& name, float ior, float alpha,
                                 Inputs more = {}) {
    more["ior"] = ior;
    more["roughness"] = pair(alpha);
    return makeNode(name, "ND_dielectric_bsdf", more);
}

/// F + (1 - F) a (1 - R) / (1 - a R): a smooth interface over a diffuse base of albedo a, with R
/// the reflectance for diffuse light from inside.
inline double interfaceOverDiffuse(double ior, double a, float degrees) {
    double mean = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n;
        mean += 2.0 * c * sh64::fresnelDielectric(c, ior) / n;
    }
    const double inside = 1.0 - (1.0 - mean) / (ior * ior);
    const double f = sh64::fresnelDielectric(std::cos(double(glm::radians(degrees))), ior);
    return f + (1.0 - f) * a * (1.0 - inside) / (1.0 - a * inside);
}

} // namespace patina

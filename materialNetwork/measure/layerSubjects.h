// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/material.h"

#include "shaders/measure/measure.h"

#include <memory>

namespace patina::measure {

/// A base under an interface: grey diffuse, or a metal where extinction is above 0.
struct Base {
    double grey = 0.0;
    double ior = 0.0, extinction = 0.0;
    double alpha = 0.0; ///< of the metal's facets
};

/// @param alpha of the interface, of ior 1.5; negative: the base alone
/// @param methods at the choice points
std::shared_ptr<const MaterialProgram> layered(const Base& base, double alpha,
                                               const MethodChoices& methods);

/// Mean weight of samples, and its standard error.
struct Albedo {
    double mean, sigma;
};
Albedo sampledAlbedo(const MaterialProgram& program, double cosine, int samples);

/// The directional albedo as it is computed, delta lobes included.
double knownAlbedo(const MaterialProgram& program, double cosine);

/// Times laying out, one value and one sample at places of all cosines.
void timeEvaluations(const std::vector<std::shared_ptr<const MaterialProgram>>& programs, Row& row);

} // namespace patina::measure

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "base/diagnostics.h"

#include <functional>

namespace patina {

/// How trim curves become polylines.
struct TrimOptions {
    glm::dvec2 low, high;                          ///< ends of the parameters that are drawn
    int pieces = 1;                                ///< of a curved span at least
    double longest = 0.0;                          ///< piece on the surface, in its units; 0: any
    size_t budget = 0;                             ///< of pieces
    std::function<dvec3(const glm::dvec2&)> place; ///< of parameters
};

/// Loops of trim curves as closed polylines, in steps of trimCells(). Unsound ones are told of and
/// left out.
std::vector<std::vector<glm::dvec2>> trimLoops(const TrimCurves& trim, const std::string& prim,
                                               const TrimOptions& options,
                                               Diagnostics& diagnostics);

} // namespace patina

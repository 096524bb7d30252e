// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <functional>

namespace patina {

using glm::dvec2;

/// Parameters of a patch count whole steps, so that sums and products of a few are exact: from 0
/// to this, as fine as floats.
inline constexpr double trimSteps = 16777216.0;

/// Part of a cell of a grid that stays.
struct TrimmedCell {
    int column = 0, row = 0;
    std::vector<dvec2> corners;   ///< counterclockwise
    std::vector<uvec3> triangles; ///< of corners; empty: the cell is whole, with its four corners
};

/// Cuts loops out of a grid. Triangles of one cell and of neighbours share whole edges.
/// @param x, y lines of the grid, ascending steps
/// @param loops closed polylines in steps; none lies within one cell (their insides would be holes)
/// @param keepInside keep what a ray meets the loops from an odd number of times, else the rest
void trimCells(const std::vector<double>& x, const std::vector<double>& y,
               const std::vector<std::vector<dvec2>>& loops, bool keepInside,
               const std::function<void(const TrimmedCell&)>& add);

} // namespace patina

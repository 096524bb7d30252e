// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/nurbs.h"

namespace patina {

/// A line of vertices: where it is in one direction, and the basis there.
struct PatchLine {
    NurbsBasis::Span span;
    double t = 0.0;
    std::vector<double> values, slopes;
    bool joined = false; ///< to the line before it by triangles
};

/// One direction of a patch, cut into lines of ascending parameters.
class PatchDirection {
public:
    explicit PatchDirection(const NurbsDirection& direction) : basis(direction) {}

    /// @param pieces of each span
    void chooseLines(const std::vector<int>& pieces);
    PatchLine line(const NurbsBasis::Span& span, double t, bool joined = true) const;
    /// Within the span that a parameter lies in.
    PatchLine at(double t) const;
    /// The basis a little further into the span.
    PatchLine inside(const PatchLine& line) const;

    NurbsBasis basis;
    std::vector<PatchLine> lines;
};

/// Four corners of a cell, or three of a part of one, counterclockwise; numbers of vertices. The
/// corners of a cell are a b c d by rows.
struct PatchFace {
    uint32_t a, b, c, d;
    int segment; ///< between two knots in both directions
    bool whole;
};

/// Vertices where lines of both directions cross, and the faces between them.
struct PatchGrid {
    std::vector<uvec2> vertices; ///< numbers of lines in u and v
    std::vector<PatchFace> faces;
};

/// The whole patch.
PatchGrid wholeGrid(const PatchDirection& u, const PatchDirection& v);

/// The patch without what its trim curves cut off. Vertices on them, and lines through loops that
/// lie within one cell, are added to both directions.
/// @param loops as trimLoops() makes them, one at least
PatchGrid trimmedGrid(PatchDirection& u, PatchDirection& v,
                      const std::vector<std::vector<glm::dvec2>>& loops, bool keepInside);

} // namespace patina

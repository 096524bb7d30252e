// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"

namespace patina {

/// Splits the segments of ribbons (Bezier curves with normals) until none turns by much. Embree
/// finds the edges of a segment from its two ends, and gets the width of one that turns wrong.
void splitRibbons(CurveSet& set);

} // namespace patina

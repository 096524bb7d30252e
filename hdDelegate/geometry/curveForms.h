// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "base/diagnostics.h"

namespace patina {

/// UsdGeomHermiteCurves: cubic between points, with a tangent at each. `basis` and `wrap` count for
/// nothing.
struct HermiteCurves : Curves {
    Sampled<std::vector<vec3>> tangents; ///< one per point; as many samples as points, or one
};

/// UsdGeomNurbsCurves. `basis` and `wrap` count for nothing.
struct NurbsCurves : Curves {
    std::vector<int> orders;     ///< per curve
    std::vector<double> knots;   ///< vertex count + order of each curve, one curve after another
    std::vector<double> ranges;  ///< two per curve: the part that is drawn; empty: all
    std::vector<double> weights; ///< one per point, not multiplied into it; empty: all 1
};

/// The same curves as Bezier ones, exactly. Values of primvars per point are linear between points,
/// as UsdGeomHermiteCurves suggests. Tangents that do not fit are taken as the way from point to
/// point, with a warning.
std::shared_ptr<const Curves> toBezier(const HermiteCurves& curves, Diagnostics& diagnostics);

/// The same curves as Bezier ones: exactly up to order 4 without weights, else cut until they are
/// within 1e-5 of the size of the curve. Vertex primvars have the points' basis, varying ones
/// (vertex count - order + 2 of each curve) are linear from knot to knot. Curves whose order, knots
/// or number of points cannot be used are left out with a warning. Without any order they are
/// lines through their points, with a warning.
std::shared_ptr<const Curves> toBezier(const NurbsCurves& curves, Diagnostics& diagnostics);

} // namespace patina

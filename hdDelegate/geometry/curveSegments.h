// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"

namespace patina {

/// One authored curve taken apart.
struct CurveLayout {
    /// A control point: authored point a, or the phantom 2 a - b of a pinned curve.
    struct Point {
        int a = 0, b = -1;
        bool phantom() const { return b >= 0; }
    };
    std::vector<Point> points; ///< local to the curve; repeated at the end of periodic curves
    int segments = 0;
    int step = 1;   ///< control points from one segment to the next
    int unused = 0; ///< authored points at the end that no segment can use
};

/// Takes a curve of some number of points apart, as UsdGeomBasisCurves says. A curve that has too
/// few points has no segments.
/// @param lists whether the points are listed, too
CurveLayout curveLayout(int pointCount, CurveBasis basis, CurveWrap wrap, bool lists = true);

/// How many varying values such a curve has: one at each end of its segments. OpenUSD counts a
/// curve that is too short as one segment.
int varyingCount(const CurveLayout& layout, CurveWrap wrap);

/// Weights of the four control points of a cubic segment at u (two of them for linear ones).
vec4 basisWeights(CurveBasis basis, float u);

/// Derivatives of basisWeights by u.
vec4 basisSlopes(CurveBasis basis, float u);

/// How many values of an attribute a segment has for itself: 0, 2 or 4.
int valuesOfSegment(MeshAttribute::Rate rate);

/// Weights of these values at u.
vec4 valueWeights(MeshAttribute::Rate rate, float u);

/// Bezier control points of a cubic segment. T is float, vec3...
template <class T> void toBezier(CurveBasis basis, const T p[4], T out[4]) {
    switch (basis) {
    case CurveBasis::Bspline:
        out[0] = (p[0] + 4.0f * p[1] + p[2]) / 6.0f;
        out[1] = (2.0f * p[1] + p[2]) / 3.0f;
        out[2] = (p[1] + 2.0f * p[2]) / 3.0f;
        out[3] = (p[1] + 4.0f * p[2] + p[3]) / 6.0f;
        break;
    case CurveBasis::CatmullRom:
        out[0] = p[1];
        out[1] = p[1] + (p[2] - p[0]) / 6.0f;
        out[2] = p[2] - (p[3] - p[1]) / 6.0f;
        out[3] = p[2];
        break;
    case CurveBasis::Linear:
        out[0] = p[0];
        out[1] = (2.0f * p[0] + p[1]) / 3.0f;
        out[2] = (p[0] + 2.0f * p[1]) / 3.0f;
        out[3] = p[1];
        break;
    case CurveBasis::Bezier:
        for (int i = 0; i < 4; ++i)
            out[i] = p[i];
        break;
    }
}

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/curveSegments.h"

#include <algorithm>

namespace patina {

CurveLayout curveLayout(int pointCount, CurveBasis basis, CurveWrap wrap, bool lists) {
    CurveLayout layout;
    const bool periodic = wrap == CurveWrap::Periodic;
    const bool phantoms = wrap == CurveWrap::Pinned &&
                          (basis == CurveBasis::Bspline || basis == CurveBasis::CatmullRom);
    const int n = pointCount;
    int used = n;
    switch (basis) {
    case CurveBasis::Linear: layout.segments = periodic ? (n >= 3 ? n : 0) : n - 1; break;
    case CurveBasis::Bezier:
        layout.step = 3;
        layout.segments = periodic ? n / 3 : (n - 1) / 3;
        used = periodic ? 3 * layout.segments : 3 * layout.segments + 1;
        break;
    default: layout.segments = periodic ? (n >= 3 ? n : 0) : phantoms ? n - 1 : n - 3; break;
    }
    layout.segments = std::max(layout.segments, 0);
    if (n < 2 || layout.segments == 0) {
        layout.segments = 0;
        return layout;
    }
    layout.unused = n - used;
    if (!lists) return layout;
    const int last = (layout.segments - 1) * layout.step + (basis == CurveBasis::Linear ? 2 : 4);
    if (phantoms) layout.points.push_back({0, 1});
    for (int i = 0; int(layout.points.size()) < last && i < used; ++i)
        layout.points.push_back({i, -1});
    if (phantoms) layout.points.push_back({n - 1, n - 2});
    for (int i = 0; int(layout.points.size()) < last; ++i)
        layout.points.push_back({i % used, -1});
    return layout;
}

int varyingCount(const CurveLayout& layout, CurveWrap wrap) {
    if (wrap == CurveWrap::Periodic) return layout.segments;
    return std::max(layout.segments, 1) + 1;
}

vec4 basisWeights(CurveBasis basis, float u) {
    const float v = 1.0f - u;
    switch (basis) {
    case CurveBasis::Bezier: return vec4(v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u);
    case CurveBasis::Bspline:
        return vec4(v * v * v, 3 * u * u * u - 6 * u * u + 4, 3 * v * v * v - 6 * v * v + 4,
                    u * u * u) /
               6.0f;
    case CurveBasis::CatmullRom:
        return 0.5f * vec4(u * (-1 + u * (2 - u)), 2 + u * u * (-5 + 3 * u),
                           u * (1 + u * (4 - 3 * u)), u * u * (-1 + u));
    case CurveBasis::Linear: break;
    }
    return vec4(v, u, 0, 0);
}

int valuesOfSegment(MeshAttribute::Rate rate) {
    return rate == MeshAttribute::Rate::PerCorner    ? 2
           : rate == MeshAttribute::Rate::PerControl ? 4
                                                     : 0;
}

vec4 valueWeights(MeshAttribute::Rate rate, float u) {
    return basisWeights(
        rate == MeshAttribute::Rate::PerControl ? CurveBasis::Bezier : CurveBasis::Linear, u);
}

vec4 basisSlopes(CurveBasis basis, float u) {
    const float v = 1.0f - u;
    switch (basis) {
    case CurveBasis::Bezier:
        return 3.0f * vec4(-v * v, v * v - 2 * u * v, 2 * u * v - u * u, u * u);
    case CurveBasis::Bspline: return 0.5f * vec4(-v * v, u * (3 * u - 4), v * (4 - 3 * v), u * u);
    case CurveBasis::CatmullRom:
        return 0.5f *
               vec4(-1 + u * (4 - 3 * u), u * (-10 + 9 * u), 1 + u * (8 - 9 * u), u * (-2 + 3 * u));
    case CurveBasis::Linear: break;
    }
    return vec4(-1, 1, 0, 0);
}

} // namespace patina

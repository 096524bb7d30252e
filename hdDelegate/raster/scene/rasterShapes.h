// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledShapes.h"

namespace patina {

/// How a strip ends. Its normal is that long, as the vertex stage has it (instance.glsl): the rim
/// of an open tube shows as half an ellipse, and round ends as half a circle, for which it is
/// longer.
enum StripEnd {
    StripGoesOn = 1,
    StripEnds = 2,
    StripBegins = 3,
    StripEndsRound = 4,
    StripBeginsRound = 5
};

/// Above the StripEnd of vertices that the vertex stage raises over a strip.
constexpr float StripDome = 8.0f;

/// Triangles, and how shaders read them.
struct RasterTriangles {
    TriangleMesh mesh;
    /// Per vertex of a strip: its half width, negative on the right. Such a vertex is on the axis
    /// of a curve, its normal goes along it, and the vertex stage moves it aside, so that the strip
    /// faces whoever looks. Empty: no strips.
    std::vector<float> halfWidth;
    /// Of strips, by vertex: whether the tube ends there and how, a StripEnd; more by StripDome
    /// where the vertex is on the dome over the strip (instance.glsl).
    std::vector<float> ends;
    /// Of curves, per triangle: along, as long as the radius. Empty: tangents follow from a uv set.
    std::vector<vec3> along;
    /// Of curves, per triangle: how much the radius grows along it, by the length.
    std::vector<float> slope;
};

/// The primitives that a shape is drawn as.
struct RasterForm {
    RasterTriangles seen;
    RasterTriangles casting; ///< for shadow maps; without triangles: as it is seen
};

/// How finely curves and points are drawn.
struct RasterFineness {
    float gap = 0.0f; ///< largest distance from the true shape, object units; 0: as coarse as ever
    float thick = 0.0f;               ///< curves with a smaller radius are strips, object units
    size_t pointTriangles = 16000000; ///< of the points of a prim, where the coarsest allow it
};

/// Curves and points as triangles: strips, tubes or ribbons, and spheres or disks.
RasterForm rasterTriangles(const PrimShape& shape, const RasterFineness& fineness);

/// Makes curves coarser until they take so many triangles at most, as far as that is possible.
/// @returns whether they are thin enough for strips
bool fitCurves(const CurveSet& set, RasterFineness& fineness, size_t maximum);
/// Whether strips may be domed, too.
bool domedStripsFit(const CurveSet& set, const RasterFineness& fineness, size_t maximum);

/// Curves as Embree has them: circles swept along cubic segments, open at the ends; cones and
/// spheres along linear ones. Tubes and ribbons here are polygons; strips face whoever looks.
/// Domed ones have nearly the depths of tubes, so that those which reach into each other are seen
/// as far as they would be; they take three times the triangles.
RasterTriangles curveTriangles(const CurveSet& set, const RasterFineness& fineness, bool strips,
                               bool domed = false);

} // namespace patina

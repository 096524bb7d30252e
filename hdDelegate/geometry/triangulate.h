// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

namespace patina {

/// Cuts one polygon into count - 2 triangles of the same winding and appends them, as corner
/// numbers 0..count-1. Quads are cut along the shorter diagonal, from the reflex corner when they
/// are concave; larger polygons by ear clipping in the plane of their Newell normal. Degenerate and
/// self-intersecting polygons give some triangulation, always of count - 2 triangles.
/// @param corners the polygon, count >= 3 finite points
void triangulatePolygon(const vec3* corners, int count, std::vector<uvec3>& out);

/// Cuts a counterclockwise polygon of a plane into count - 2 triangles; it may touch itself.
void clipEars(const std::vector<glm::dvec2>& corners, std::vector<uvec3>& out);

/// Above this many corners a concave polygon is cut as a fan, since ear clipping is quadratic.
constexpr int maxEarClipping = 8192;

/// Sum of the cross products of a polygon's edges: its normal, twice its area long.
vec3 newellNormal(const vec3* corners, int count);

} // namespace patina

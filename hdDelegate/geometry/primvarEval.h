// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"

namespace patina {

/// Reads an attribute at a point of a triangle: (1 - u - v) a + u b + v c.
/// @param out up to four components; those that the attribute does not have are 0
/// @returns false, and zeros, when the attribute does not fit the mesh
bool evalAttribute(const TriangleMesh& mesh, const MeshAttribute& attribute, unsigned triangle,
                   float u, float v, float out[4]);

/// Reads an attribute along a curve segment. @param u 0..1 along the segment
bool evalAttribute(const CurveSet& curves, const MeshAttribute& attribute, unsigned segment,
                   float u, float out[4]);

/// Reads an attribute of a point.
bool evalAttribute(const PointSet& points, const MeshAttribute& attribute, unsigned point,
                   float out[4]);

/// The shading normal at a point of a triangle, unit length, interpolated between the steps of the
/// shutter. The geometric one where the mesh is faceted or the interpolated one vanishes; zero for
/// a degenerate triangle.
/// @param time 0..1 over the shutter
vec3 evalNormal(const TriangleMesh& mesh, unsigned triangle, float u, float v, float time = 0.0f);

} // namespace patina

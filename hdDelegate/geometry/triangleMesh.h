// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"

#include <cstdint>
#include <string>
#include <vector>

namespace patina {

/// A primvar as the back ends read it: values on the tessellation, without indices.
struct MeshAttribute {
    /// On what the values stand.
    /// - Constant: one value.
    /// - PerFace: one per authored face; index triangleFace[t]. On curves one per authored curve,
    ///   index segmentCurve[s].
    /// - PerVertex: one per position (mesh) or point (points).
    /// - PerCorner: three per triangle, index 3 * t + corner; on curves two per segment, index
    ///   2 * s + end, linear in between.
    /// - PerControl: on cubic curves alone, four Bezier values per segment, index 4 * s + k.
    enum class Rate { Constant, PerFace, PerVertex, PerCorner, PerControl };

    std::string name;
    int components = 1; ///< floats per value, 1..16
    Rate rate = Rate::Constant;
    std::vector<float> data; ///< always finite
};

/// Triangles that both back ends draw. Positions are those of the prim's object space; the
/// geometric normal cross(b - a, c - a) of every triangle points out of the front face, whatever
/// the orientation of the prim.
struct TriangleMesh {
    std::vector<std::vector<vec3>> positions; ///< per time step, uniform over the shutter
    std::vector<uvec3> triangles;
    std::vector<std::vector<vec3>> normals; ///< unit length; one or as many steps as positions;
                                            ///< empty means faceted
    MeshAttribute::Rate normalRate = MeshAttribute::Rate::PerVertex; ///< not Constant
    std::vector<int> triangleFace;                                   ///< authored face
    std::vector<uint16_t> triangleSubset;  ///< 0 none, i + 1 is subsets[i]; empty: no subsets
    std::vector<MeshAttribute> attributes; ///< normals are not among them
    vec3 boundsMin{0.0f}, boundsMax{0.0f}; ///< of all time steps; zero when there are no triangles
    int refineLevel = 0;                   ///< uniform subdivisions that were made

    const MeshAttribute* attribute(const std::string& name) const;
};

/// Curves as Embree takes them. Cubic segments have four consecutive control points, linear ones
/// two.
struct CurveSet {
    CurveBasis basis = CurveBasis::Linear; ///< of controlPoints; may differ from the authored one
    std::vector<std::vector<vec4>> controlPoints; ///< x, y, z, radius; per time step
    std::vector<uint32_t> segments;               ///< first control point of each segment
    std::vector<int> segmentCurve;                ///< authored curve of each segment
    std::vector<vec2>
        segmentU; ///< curve parameter at both ends of each segment, 0..1 along a curve
    std::vector<uint16_t> segmentSubset;    ///< 0 none, i + 1 is subsets[i]; empty: no subsets
    std::vector<std::vector<vec3>> normals; ///< per control point; empty means tubes, else ribbons
    std::vector<MeshAttribute> attributes;  ///< not PerVertex
    vec3 boundsMin{0.0f}, boundsMax{0.0f};

    const MeshAttribute* attribute(const std::string& name) const;
};

/// Spheres, or disks where there are normals.
struct PointSet {
    std::vector<std::vector<vec4>> points;  ///< centre and radius; per time step
    std::vector<std::vector<vec3>> normals; ///< per point; empty means spheres
    std::vector<int> pointIndex;            ///< authored point of each
    std::vector<uint16_t> pointSubset;      ///< 0 none, i + 1 is subsets[i]; empty: no subsets
    std::vector<MeshAttribute> attributes;  ///< Constant or PerVertex
    vec3 boundsMin{0.0f}, boundsMax{0.0f};

    const MeshAttribute* attribute(const std::string& name) const;
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledShapes.h"
#include "hdDelegate/compiled/instanceValues.h"
#include "hdDelegate/embree/sharedShapes.h"
#include "hdDelegate/scene/geometry.h"
#include "materialNetwork/cpu/materialProgram.h"
#include "materialNetwork/shadingPoint.h"

#include <memory>

namespace patina {

/// A material as one prim uses it: the program, and where its primvars are found on the prim.
struct MaterialSlot {
    std::shared_ptr<const MaterialProgram> program;
    std::vector<int> attributes; ///< per program->primvars(): index of the prim's attribute, or -1
    int tangentSet = -1;         ///< the attribute that tangents follow, or -1
    /// As `attributes`, of the uv sets whose tangents are read; empty: none are.
    std::vector<int> tangents;
    bool opaque = true; ///< opacity is 1 everywhere on this prim
};

/// A prim's shape for rays, in its group's space (world space for prims that are not instanced),
/// at each time step.
struct PlacedShape {
    std::vector<std::vector<vec3>> positions; ///< of triangles
    std::vector<std::vector<vec4>> points;    ///< with radii: of curves' control points, of points
    std::vector<std::vector<vec3>> normals;   ///< of each of these
};

/// A prim made ready for rays.
struct Surface {
    std::shared_ptr<const Geometry> prim;
    /// Topology and values, which the rasterizer may draw too; and, in interactive renders, what
    /// PlacedShape has, in the prim's own space. Null where `shared` is not.
    std::shared_ptr<const PrimShape> rest;
    PlacedShape placed;
    /// In the prim's own space, at ScreenMotion's moments, where its points move and an AOV tells
    /// motion; else empty.
    PlacedShape moments;
    /// Of one implicit prim among many: the triangles stand here, and its hits are those of an
    /// instance.
    std::shared_ptr<const SharedShape> shared;
    std::vector<MeshAttribute> own;      ///< what a prim with a shared shape has of values
    std::vector<mat4> places;            ///< from the shared shape to the group, at uniform steps
    std::vector<MaterialSlot> materials; ///< [0] the prim's, [i + 1] that of subset i
    mat4 groupToObject{1.0f};            ///< at the middle of the shutter
    vec3 worldOrigin{0.0f};              ///< of the space that rays are traced in
    bool flipNormals = false;            ///< the baked transform mirrors: windings turn
    int primId = 0;                      ///< for the AOV: rank of the prim's path
    std::vector<int> categories;         ///< interned names, sorted

    enum class Shape { Triangles, Curves, Points } shape = Shape::Triangles;

    const std::vector<MeshAttribute>& attributes() const {
        return shared                      ? own
               : shape == Shape::Triangles ? rest->mesh.attributes
               : shape == Shape::Curves    ? rest->curves.attributes
                                           : rest->points.attributes;
    }
    /// Positions and normals of triangles.
    const std::vector<std::vector<vec3>>& positions() const {
        return shared ? shared->mesh.positions : placed.positions;
    }
    const std::vector<std::vector<vec3>>& normals() const {
        return shared ? shared->mesh.normals : placed.normals;
    }
    /// Where triangles, faces and values stand.
    const TriangleMesh& topology() const { return shared ? shared->mesh : rest->mesh; }
    mat4 placeAt(float time) const; ///< of a shared shape. @param time 0..1 over the shutter
    int findAttribute(const std::string& name) const;
    /// The place of the uv set that tangents follow, as of tangentSet(); -1: none
    int findTangentSet(const std::string& wanted) const;
    const MeshAttribute& attribute(int index) const; ///< of findAttribute()
    const MaterialSlot& material(unsigned primitive) const;
    int element(unsigned primitive) const; ///< authored face, curve or point index
};

/// One hit of a ray, before anything is computed from it.
struct Hit {
    const Surface* surface = nullptr;
    unsigned primitive = 0;
    float u = 0.0f, v = 0.0f, distance = 0.0f, time = 0.0f;
    vec3 groupNormal{0.0f}; ///< Embree's geometric normal, group space, not normalised
    bool instanced = false;
    mat4 groupToWorld{1.0f};
    int instanceId = -1;
    const std::vector<int>* instanceCategories = nullptr;
    static constexpr int maxSteps = 9; ///< TraceContext::maxDepth and an instance of Embree's
    int stepCount = 0;
    InstanceStep steps[maxSteps]; ///< the first stepCount: from the outermost instance inwards
};

/// How the camera sees what was hit: as the prim says, or an instance around it.
Catching catchingOf(const Hit& hit);

/// The dielectric priority of what was hit: the prim's, else that of the innermost instance that
/// has one.
int dielectricPriorityOf(const Hit& hit);

/// Reads an attribute of a surface at a hit. @returns false when the attribute has no value there.
bool readAttribute(const Surface& surface, int attribute, unsigned primitive, float u, float v,
                   float out[4]);

/// Reads a primvar at a hit by its name: the prim's own, else that of an instance around it.
/// @returns false when neither has a value there
bool readPrimvar(const Hit& hit, const std::string& name, float out[4]);

/// Everything about the surface at a hit; also the reader of its primvars.
struct SurfacePoint : PrimvarReader {
    const Hit* hit = nullptr;
    const MaterialSlot* slot = nullptr;
    ShadingPoint shading;
    float offset = 0.0f;      ///< distance by which rays that leave start off the surface
    float fibreRadius = 0.0f; ///< of a tube whose material is a fibre
    bool fibre = false;       ///< the material is a fibre: the lobes are those of its whole width

    /// Where a ray that leaves starts. From a fibre that is the other side of the tube when it goes
    /// inwards, for the lobes have taken it through already.
    vec3 departure(const vec3& direction) const;

    bool read(int slotIndex, float out[4]) const override;
};

/// Fills a surface point.
/// @param origin,direction of the ray in world space
/// @param coneWidth of the ray at the hit, scene units
void computeSurfacePoint(const Hit& hit, const vec3& origin, const vec3& direction, float coneWidth,
                         SurfacePoint& out);

} // namespace patina

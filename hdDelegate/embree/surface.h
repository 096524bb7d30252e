#pragma once

#include "hdDelegate/compiled/instanceValues.h"
#include "hdDelegate/embree/sharedShapes.h"
#include "hdDelegate/geometry/triangleMesh.h"
#include "hdDelegate/scene/geometry.h"
#include "materialNetwork/cpu/materialProgram.h"
#include "materialNetwork/shadingPoint.h"

#include <memory>

namespace patina {

/// A material as one prim uses it: the program, and where its primvars are found on the prim.
struct MaterialSlot {
    std::shared_ptr<const MaterialProgram> program;
    std::vector<int> attributes; ///< per program->primvars(): index of the prim's attribute, or -1
    bool opaque = true;          ///< opacity is 1 everywhere on this prim
};

/// A prim made ready for rays. Positions and normals are those of its group's space (world space
/// for prims that are not instanced).
struct Surface {
    std::shared_ptr<const Geometry> prim;
    /// Topology and values of triangles, which the rasterizer may draw too; and, in interactive
    /// renders, positions and normals in the prim's own space. Null for other shapes.
    std::shared_ptr<const TriangleMesh> rest;
    TriangleMesh mesh; ///< positions and normals
    CurveSet curves;
    PointSet points;
    /// Of one implicit prim among many: the triangles stand here, `mesh` has no more than what is
    /// the prim's own, and its hits are those of an instance.
    std::shared_ptr<const SharedShape> shared;
    std::vector<mat4> places;            ///< from the shared shape to the group, at uniform steps
    std::vector<MaterialSlot> materials; ///< [0] the prim's, [i + 1] that of subset i
    mat4 groupToObject{1.0f};            ///< at the middle of the shutter
    vec3 worldOrigin{0.0f};              ///< of the space that rays are traced in
    bool flipNormals = false;            ///< the baked transform mirrors: windings turn
    int primId = 0;                      ///< for the AOV: rank of the prim's path
    std::vector<int> categories;         ///< interned names, sorted
    int stAttribute = -1;

    enum class Shape { Triangles, Curves, Points } shape = Shape::Triangles;

    const std::vector<MeshAttribute>& attributes() const {
        return shape == Shape::Triangles ? (rest ? rest->attributes : mesh.attributes)
               : shape == Shape::Curves  ? curves.attributes
                                         : points.attributes;
    }
    /// Where positions and normals stand.
    const TriangleMesh& placed() const { return shared ? shared->mesh : mesh; }
    /// Where triangles, faces and values stand.
    const TriangleMesh& topology() const { return rest ? *rest : shared ? shared->mesh : mesh; }
    mat4 placeAt(float time) const; ///< of a shared shape. @param time 0..1 over the shutter
    int findAttribute(const std::string& name) const;
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

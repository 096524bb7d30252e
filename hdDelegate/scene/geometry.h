// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <memory>

namespace patina {

class Diagnostics;

/// Faces (or curves, or points) of a prim with a material of their own.
struct GeomSubset {
    std::string path;
    std::string material;
    std::vector<int> faces; ///< indices out of range are dropped with a warning
};

/// Kinds of rays, as the bits of masks.
enum RayMask : unsigned {
    RayCamera = 1,
    RayDiffuse = 2,
    RayShadow = 4,
    RaySpecular = 8,
    RayTransmission = 16,
    RayVolume = 32,
    RayIndirect = RayDiffuse | RaySpecular | RayTransmission | RayVolume,
    RayAny = RayCamera | RayIndirect | RayShadow
};

/// Which rays see a prim.
struct Visibility {
    bool camera = true;
    bool diffuse = true; ///< reflected by a diffuse lobe
    bool shadow = true;
    bool specular = true; ///< reflected by any other lobe
    bool transmission = true;
    bool volume = true; ///< scattered by a medium

    static Visibility all(bool seen) { return {seen, seen, seen, seen, seen, seen}; }
    unsigned mask() const { ///< of RayMask
        return (camera ? RayCamera : 0u) | (diffuse ? RayDiffuse : 0u) | (shadow ? RayShadow : 0u) |
               (specular ? RaySpecular : 0u) | (transmission ? RayTransmission : 0u) |
               (volume ? RayVolume : 0u);
    }
    bool sees(unsigned rays) const { return (mask() & rays) != 0; }
};

/// How the camera sees a matte or catcher in place of its own light. Other rays meet it as it is.
struct Catching {
    bool matte = false;       ///< nothing: a hole in the picture, black and without alpha
    bool shadows = false;     ///< black, as opaque as it is in shadow
    bool reflections = false; ///< what it mirrors of other prims, as opaque as it mirrors

    bool any() const { return matte || shadows || reflections; }
};

/// What primvars of primMarks.def say of a prim, or of all that is in an instance.
struct Marked {
    Visibility visibility;
    Catching catching;
    std::string matteName;      ///< in cryptoObject; empty: its path, see objectMatte()
    std::string assetName;      ///< in cryptoAsset; empty: that of what is around, see assetMatte()
    int dielectricPriority = 0; ///< of what it encloses, see MediumStack; 0: none
};

enum class SubdivisionScheme { None, CatmullClark, Loop, Bilinear };
/// Of particles, as UsdVol's ParticleFieldKernel...API have them: exp(-r²/2) in space or on the xy
/// plane alone, or 1 on the unit disk of that plane.
enum class SplatShape { GaussianEllipsoid, GaussianSurflet, ConstantSurflet };
enum class GeometryKind { Mesh, Curves, Points, Implicit, Volume, Splats };

/// Whether prims of a kind have surfaces that rays meet. The others fill the space.
inline bool isSurface(GeometryKind kind) {
    return kind != GeometryKind::Volume && kind != GeometryKind::Splats;
}

/// The members of every gprim.
struct Geometry : Marked {
    std::string path;
    std::string group; ///< prototype that this prim belongs to; empty means the world itself
    GeometryKind kind = GeometryKind::Mesh;
    MotionTransform transform{mat4(1.0f)}; ///< local to group (or world)
    std::string material;                  ///< path of a MaterialPrim; empty shows displayColor
    std::vector<GeomSubset> subsets;
    std::vector<Primvar>
        primvars; ///< displayColor, displayOpacity, st, normals (on curves, points and meshes)...
    std::vector<std::string>
        categories; ///< names of light and shadow link collections that hold it
    bool doubleSided = true;
    bool leftHanded = false;
    std::string lightGroup; ///< label of the light that it gives off; empty: none
    std::string renderTag;  ///< Hydra's name of its purpose (proxy, render, guide); empty: geometry
    int id = -1;            ///< for the primId AOV; -1: the rank of its path

    virtual ~Geometry() = default;
    const Primvar* primvar(const std::string& name) const;
};

/// One direction of a NURBS surface.
struct NurbsDirection {
    int vertexCount = 0;
    int order = 0;                ///< degree + 1
    std::vector<double> knots;    ///< vertexCount + order of them, ascending
    double low = 0.0, high = 0.0; ///< part that is drawn; all of it where low is not below high
};

/// The trim curves of a UsdGeomNurbsPatch, as authored. A point is inside of them where a ray from
/// it crosses them an odd number of times (RenderMan Interface, RiTrimCurve).
struct TrimCurves {
    std::vector<int> counts;               ///< curves of each loop
    std::vector<int> orders, vertexCounts; ///< of each curve
    std::vector<double> knots;             ///< vertex count + order of each curve
    std::vector<double> ranges;            ///< two per curve: the part that counts; empty: all
    std::vector<double> points;            ///< three each: u and v, multiplied by w, and w
    bool keepInside = false;               ///< what is inside is drawn, and not what is outside
};

/// The attributes of a UsdGeomNurbsPatch, in a mesh.
struct NurbsPatch {
    NurbsDirection u, v;
    std::vector<double> weights; ///< one per control point, not multiplied into it; empty: all 1
    TrimCurves trim;
};

/// UsdGeomMesh, or a UsdGeomNurbsPatch.
struct Mesh : Geometry {
    Sampled<std::vector<vec3>> points;
    std::vector<int> faceVertexCounts;
    std::vector<int> faceVertexIndices;
    std::vector<int> holeIndices;
    SubdivisionScheme scheme = SubdivisionScheme::None;
    std::string interpolateBoundary = "edgeAndCorner"; ///< none, edgeOnly, edgeAndCorner
    std::string faceVaryingLinearInterpolation = "cornersPlus1";
    std::string triangleSubdivisionRule = "catmullClark"; ///< catmullClark, smooth
    std::vector<int> creaseIndices, creaseLengths;
    std::vector<float> creaseSharpnesses;
    std::vector<int> cornerIndices;
    std::vector<float> cornerSharpnesses;
    int refineLevel = 0; ///< floor of the refinement (usdview complexity low 0 .. veryhigh 3)
    /// If given, `points` are the control points, u fastest, and the faces are their grid (see
    /// setNurbsCage), which nothing draws: it tells how large the surface is.
    std::shared_ptr<const NurbsPatch> patch;

    Mesh() { kind = GeometryKind::Mesh; }
};

enum class CurveBasis { Linear, Bezier, Bspline, CatmullRom };
enum class CurveWrap { Nonperiodic, Periodic, Pinned };

/// Width of lines that stand in for a model (its box, its axes), of the diagonal of their bounds.
inline constexpr float standInWidth = 0.005f;

/// UsdGeomBasisCurves. With a primvar `normals` the curves are ribbons, else tubes.
/// Widths (diameters) come as primvar `widths`, any interpolation.
struct Curves : Geometry {
    Sampled<std::vector<vec3>> points;
    std::vector<int> curveVertexCounts;
    CurveBasis basis = CurveBasis::Linear;
    CurveWrap wrap = CurveWrap::Nonperiodic;

    Curves() { kind = GeometryKind::Curves; }
};

/// UsdGeomPoints: spheres of diameter `widths` (primvar), or disks where `normals` are given.
struct Points : Geometry {
    Sampled<std::vector<vec3>> points;

    Points() { kind = GeometryKind::Points; }
};

enum class ImplicitShape { Sphere, Cube, Cone, Cylinder, Capsule, Plane };

/// UsdGeom implicit prims. Sizes are in the prim's own units.
struct Implicit : Geometry {
    ImplicitShape shape = ImplicitShape::Sphere;
    int axis = 2; ///< 0 X, 1 Y, 2 Z
    float radius = 1.0f;
    float radiusTop = -1.0f; ///< Cylinder_1 and Capsule_1; negative means as radius
    float height = 2.0f;     ///< of cone, cylinder, capsule (without caps)
    float size = 2.0f;       ///< edge of the cube
    float width = 2.0f;      ///< of the plane
    float length = 2.0f;     ///< of the plane

    Implicit() { kind = GeometryKind::Implicit; }
};

class FieldGrid;

/// A field of a volume: a grid of values in space.
struct VolumeField {
    std::string name;                      ///< that materials know it by
    std::string file;                      ///< OpenVDB, resolved path
    std::string field;                     ///< name of the grid in the file
    std::shared_ptr<const FieldGrid> grid; ///< if given, instead of a file
};

/// UsdVolVolume. Its material is a volume shader, evaluated at every point with the fields as
/// primvars. A material that reads none of them is scaled by the field `density`.
struct Volume : Geometry {
    std::vector<VolumeField> fields;
    vec3 light{1.0f}; ///< VolumeLightAPI: what its glow gives to others, over what is seen of it

    Volume() { kind = GeometryKind::Volume; }
};

/// Whether the points of a prim move in its own space.
inline bool deforms(const Geometry& prim) {
    switch (prim.kind) {
    case GeometryKind::Mesh: return static_cast<const Mesh&>(prim).points.moves();
    case GeometryKind::Curves: return static_cast<const Curves&>(prim).points.moves();
    case GeometryKind::Points: return static_cast<const Points&>(prim).points.moves();
    default: return false;
    }
}

/// Particles as a UsdVolParticleField has them. An array holds nothing, which stands
/// for the fallback of the schema, or as many elements as there are particles.
struct SplatCloud {
    SplatShape shape = SplatShape::GaussianEllipsoid;
    std::vector<vec3> positions;
    std::vector<vec4> orientations; ///< quaternions, the real part first; fallback: not turned
    std::vector<vec3> scales;       ///< standard deviations along the kernels' axes; fallback: 1
    std::vector<float> opacities;   ///< at the kernels' middles; fallback: 1
    int degree = 3;                 ///< of the harmonics
    /// (degree + 1)^2 for each particle, from the lowest band to the highest; fallback: grey of
    /// 0.5.
    std::vector<vec3> harmonics;

    size_t stride() const { return size_t(degree + 1) * size_t(degree + 1); }
};

/// A field of kernels with their captured radiance.
struct Splats : Geometry {
    std::shared_ptr<const SplatCloud> cloud = std::make_shared<const SplatCloud>();
    std::string colorSpace; ///< of the radiance; empty: linear Rec.709

    Splats() { kind = GeometryKind::Splats; }
};

/// Puts an authored cloud into a prim: arrays get the length that they need, as UsdVol's schema
/// says, or are dropped. Particles that cannot be drawn get the opacity 0. Warns of what is wrong.
void setCloud(Splats& prim, SplatCloud cloud, Diagnostics& diagnostics);

/// Many copies of prototypes. A prototype is a group: every prim whose `group` is its name, and
/// every instancer whose `group` is its name (that is how instancers nest).
struct Instancer {
    std::string path;
    std::string group; ///< group that the instances appear in; empty means the world
    std::vector<std::string> prototypes;     ///< group names
    std::vector<int> prototypeIndices;       ///< per instance, into prototypes
    std::vector<MotionTransform> transforms; ///< per instance, local to group
    std::vector<int> ids; ///< per instance, for the instanceId AOV; empty = index
    /// Per prototype: how many ids there are. The AOV then holds all levels of nesting in one
    /// number, outer id * count + own id; empty: it holds the innermost id.
    std::vector<int> idCounts;
    std::vector<std::vector<std::string>>
        categories;                ///< per instance (light linking); empty = none
    std::vector<Primvar> primvars; ///< per instance (Vertex) or constant
    Visibility visibility;
    std::vector<Marked> marks; ///< per instance, beside those of the prims inside; empty = none
    /// Per instance: the path that stands for that of its group in the names of mattes, and its
    /// asset. Empty: the number of the instance tells it apart, and it has the instancer's asset.
    std::vector<std::string> names, assets;
    std::string assetName; ///< of all instances, where `assets` is empty
};

} // namespace patina

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/tangentFrames.h"
#include "hdDelegate/raster/scene/rasterInstances.h"
#include "materialNetwork/cpu/materialProgram.h"

#include <memory>

namespace patina {

/// The glow that a UsdLuxMeshLightAPI adds to the surface of a mesh.
struct RasterMeshLight {
    enum Mode { NoLight, GlowTintsLight, Independent, NoMaterialResponse };
    Mode mode = NoLight; ///< materialSyncMode of UsdLux, for the shader
    vec3 radiance{0.0f};
    std::string filtered; ///< its path, where it has light filters
};

/// A triangle that gives light, world space.
struct RasterEmitter {
    vec3 corner, edge1, edge2;
    bool twoSided = true;
    bool mirrored = false; ///< the front is the side that the cross product points away from
    float area = 0.0f;
    int category = -1;     ///< that is lit; -1: everything
    unsigned triangle = 0; ///< of the mesh of its source
    int source = 0;
    const std::string* filtered = nullptr; ///< the path of a mesh light that has filters
    size_t place = 0;                      ///< of its group
};

/// The light that one place of a triangle gives.
struct RasterEmission {
    static constexpr int thetas = 128;    ///< of what depends on the angle to the axis alone
    static constexpr int turnThetas = 64; ///< of what depends on the turn about it, too
    static constexpr int turns = 13;      ///< the last is the first again
    static constexpr int coneTurns = 61;  ///< the same about one of several cones
    static constexpr int maxValues = thetas * coneTurns;
    static_assert(maxValues >= turnThetas * turns, "of any kind");

    vec3 radiance{0.0f}; ///< where values is empty: towards everywhere
    /// Else: the axis, and what turns begin at and go towards.
    vec3 axis{0, 0, 1}, x{1, 0, 0}, y{0, 1, 0};
    /// Radiance over even steps from the axis (0..pi), for every turn one after the other.
    std::vector<vec3> values;
    int stepsOfTheta = 0, stepsOfTurn = 0;
};

/// Glowing triangles of a scene, to be chosen in proportion to about their power.
class RasterEmitters {
public:
    static constexpr size_t maxTriangles = 200000; ///< those beyond give no light to others
    static constexpr int maxSamples = 16;          ///< per pass

    void clear();
    /// Adds the triangles of one subset of a mesh at one place.
    /// @param category as of RasterEmitter
    /// @param closed no light from inside gets out: of tubes, whose maps show strips alone
    /// @param origin that `toWorld` is relative to
    /// @param steps instances around the place, whose values stand in for primvars
    /// @param place of the mesh's group
    void add(const std::shared_ptr<const TriangleMesh>& mesh, size_t subset,
             const std::shared_ptr<const MaterialProgram>& program, const RasterMeshLight& light,
             const mat4& toWorld, int category, bool closed, const vec3& origin,
             const std::vector<InstanceStep>& steps, size_t place);
    bool empty() const { return _glowing.empty(); }

    /// @returns a triangle; `within` a number in [0,1) that is left of u, `chance` the probability
    RasterEmitter choose(float u, float& within, float& chance) const;
    /// The emission of a triangle at a place. @param uv as evalAttribute() has them
    RasterEmission emission(const RasterEmitter& emitter, const vec2& uv) const;

private:
    class Place;
    static void softenEdges(Place& place, const vec2& steps, RasterEmission& out);

    /// Values that all triangles of a subset share at a place.
    struct Source {
        std::shared_ptr<const TriangleMesh> mesh;
        std::shared_ptr<const MaterialProgram> program;
        RasterMeshLight light;
        mat4 toWorld{1.0f};
        mat3 normalMatrix{1.0f};
        vec3 origin{0.0f};
        std::vector<InstanceStep> steps;
        std::vector<MeshPrimvar> primvars;       ///< of the program
        const MeshAttribute* tangents = nullptr; ///< the uv set that they follow
        bool glows = false, even = false;        ///< even: alike towards all directions of a side
        bool sides = false;                      ///< one side may give other light than the other
        bool twoSided = true, mirrored = false;  ///< of its triangles, as category
        int category = -1;
        size_t place = 0;
    };
    /// The kept values of a triangle; the rest is in the mesh.
    struct Glowing {
        unsigned triangle;
        int source;
    };
    static RasterEmitter emitterOf(const Source& source, unsigned triangle);
    float brightness(const Source& source, unsigned triangle, bool coarse) const;

    std::vector<Source> _sources;
    std::vector<Glowing> _glowing;
    std::vector<double> _sums; ///< running sums of power
};

} // namespace patina

#pragma once

#include "hdDelegate/raster/rasterInstances.h"
#include "hdDelegate/scene/triangleMesh.h"
#include "materialNetwork/cpu/materialProgram.h"

namespace patina {

/// What a UsdLuxMeshLightAPI adds to the surface of a mesh.
struct RasterMeshLight {
    enum Mode { None, Tints, Adds, Alone }; ///< of materialSyncMode, for the shader
    Mode mode = None;
    vec3 radiance{0.0f};
    std::string lightLink;
};

/// A triangle that gives light, world space.
struct RasterEmitter {
    vec3 corner, edge1, edge2;
    vec3 radiance{0.0f}; ///< at its middle
    bool twoSided = true;
    float area = 0.0f;
    int category = -1; ///< that is lit; -1: everything
};

/// Glowing triangles of a scene, to be chosen in proportion to their power.
class RasterEmitters {
public:
    static constexpr size_t maxTriangles = 200000; ///< those beyond give no light to others

    void clear();
    /// Adds the triangles of one subset of a mesh at one place.
    /// @param category as of RasterEmitter
    /// @param origin that `toWorld` is relative to
    void add(const TriangleMesh& mesh, size_t subset, const MaterialProgram& program,
             const RasterMeshLight& light, const mat4& toWorld, int category,
             const vec3& origin = vec3(0.0f));
    bool empty() const { return _emitters.empty(); }

    /// @returns a triangle; `within` a number in [0,1) that is left of u, `chance` the probability
    const RasterEmitter& choose(float u, float& within, float& chance) const;

private:
    std::vector<RasterEmitter> _emitters;
    std::vector<double> _sums; ///< running sums of power
};

} // namespace patina

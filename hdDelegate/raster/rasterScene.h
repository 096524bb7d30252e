#pragma once

#include "hdDelegate/raster/rasterCamera.h"
#include "hdDelegate/raster/rasterEmitters.h"
#include "hdDelegate/raster/rasterInstances.h"
#include "hdDelegate/raster/rasterMaterials.h"
#include "hdDelegate/scene/triangleMesh.h"

#include <atomic>

namespace patina {

/// Triangles of one prim with one material, drawn as often as the prim is instanced.
struct RasterDraw {
    const RasterMaterial* material = nullptr;
    std::shared_ptr<const Geometry> prim;
    int firstFloat = 0, floatsPerCorner = 0, cornerCount = 0;
    int firstInstance = 0, instanceCount = 0;
    int primId = 0, primvarBits = 0, flags = 0; ///< flags of vertices.glsl
    vec3 boundsMin{0.0f}, boundsMax{0.0f};      ///< object space
    RasterMeshLight meshLight;
};

/// Opaque triangles of one prim, for shadow maps.
struct RasterCaster {
    std::shared_ptr<const Geometry> prim;
    int firstIndex = 0, indexCount = 0, baseVertex = 0;
    int firstInstance = 0, instanceCount = 0;
};

/// The geometry of a scene in buffers, at one time of the shutter.
class RasterScene {
public:
    explicit RasterScene(Diagnostics& diagnostics)
        : _diagnostics(diagnostics), _materials(diagnostics) {}

    void update(const SceneState& state, const RasterCamera& camera, const RenderSettings& settings,
                const std::atomic<bool>& stop);
    /// Writes the transforms of another time of the shutter. @returns false when nothing moves
    bool moveTo(const SceneState& state, const RenderSettings& settings, float timeCode);

    const std::vector<RasterDraw>& draws() const { return _draws; }
    const RasterEmitters& emitters() const { return _emitters; }
    const std::vector<RasterCaster>& casters() const { return _casters; }
    const std::map<std::string, int>& categories() const { return _categories; }
    const vec3& boundsMin() const { return _boundsMin; }
    const vec3& boundsMax() const { return _boundsMax; }
    size_t triangles() const { return _triangles; }
    size_t trianglesDrawn() const; ///< those of every instance counted
    size_t programsBuilt() const { return _materials.programsBuilt(); }
    size_t instanceCount() const { return _instances.size(); }
    void bind(GLuint vertexArray) const; ///< buffers of vertices, indices and instances

private:
    struct GpuInstance {
        mat4 objectToWorld{1.0f}, normalToWorld{1.0f};
        int ids[4] = {-1, 0, 0, 0};
        void place(const mat4& toWorld);
    };

    void addPrim(const std::shared_ptr<const Geometry>& prim, int rank, const SceneState& state,
                 const RasterCamera& camera, const RenderSettings& settings,
                 RasterInstances& places);
    void addTriangles(const std::shared_ptr<const Geometry>& prim, const TriangleMesh& mesh,
                      size_t subset, RasterDraw draw);
    void addCaster(const std::shared_ptr<const Geometry>& prim, const TriangleMesh& mesh,
                   const std::vector<const RasterMaterial*>& materials, const RasterDraw& draw);
    void collectCategories(const SceneState& state);
    void collectMeshLights(const SceneState& state, const RenderSettings& settings);
    int linksOf(const std::vector<std::string>& prim, const std::vector<std::string>& place);

    Diagnostics& _diagnostics;
    RasterMaterials _materials;
    std::vector<RasterDraw> _draws;
    std::vector<RasterCaster> _casters;
    RasterEmitters _emitters;
    std::map<std::string, std::shared_ptr<const Light>> _meshLights; ///< by the mesh's path
    std::vector<float> _vertices;
    std::vector<vec3> _positions;
    std::vector<uint32_t> _indices;
    std::vector<GpuInstance> _instances;
    std::map<std::string, int> _categories; ///< of light and shadow links
    std::vector<int> _links;                ///< see shaders/raster/links.glsl
    std::map<std::vector<int>, int> _linkRows;
    GlBuffer _vertexBuffer, _instanceBuffer, _positionBuffer, _indexBuffer, _linkBuffer;
    vec3 _boundsMin{0.0f}, _boundsMax{0.0f};
    size_t _triangles = 0;
    bool _moves = false;
};

} // namespace patina
